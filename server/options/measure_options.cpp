// SPDX-License-Identifier: Apache-2.0
// Options of `measure`.
#include "options/cli_checks.h"

namespace raybundle {

void add_measure(CLI::App& app, Options& o) {
    MeasureOptions& m = o.measure;
    app.add_option("--plane", m.plane,
                   "Area to measure on: a corner and its two edges, each x,y,z in metres")
        ->expected(3);
    app.add_option("--point", m.points, "A point instead, x,y,z in metres; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--outline", m.outline,
                   "A level area instead: its corners, each x,y,z in metres, 3 to 64")
        ->expected(3, 64);
    app.add_option("--surrounding", m.surrounding,
                   "Measure the strip of this width around the area instead, metres")
        ->check(number_that([](double value) { return value > 0.0 && value <= 100.0; },
                            "a width above 0 and at most 100 m"));
    app.add_option("--quantity", m.quantity,
                   "HORIZONTAL, VERTICAL, NORMAL, CYLINDRICAL, SEMICYLINDRICAL (lx), "
                   "DAYLIGHT_FACTOR (%), UGR or DGP (glare at eyes there)")
        ->capture_default_str();
    app.add_option("--direction", m.direction,
                   "That the points face, x,y,z: of VERTICAL, NORMAL and SEMICYLINDRICAL; what "
                   "eyes look along, of UGR and DGP");
    app.add_option("--directions", m.directions,
                   "Of UGR and DGP: 4 or 8 horizontal views all round, the worst counts; the first "
                   "along --direction (default: -Z)")
        ->check(CLI::IsMember({0, 4, 8}));
    app.add_flag("--small-sources", m.small_sources,
                 "Of UGR: count sources of less than 0.005 m² by CIE 147");
    app.add_option("--grid", m.grid, "Points of the plane: EN12464, or COLUMNSxROWS")
        ->capture_default_str();
    app.add_option("--margin", m.margin, "Strip along the plane's edges without points, metres")
        ->check(number_that([](double value) { return value >= 0.0 && value <= 1e6; },
                            "a length of 0 to 1e6 m"));
    app.add_flag("--direct", m.direct, "Without light that surfaces have reflected");
    app.add_option("--maintenance", m.maintenance,
                   "Maintenance factor of all values (default: 1, initial values)")
        ->check(number_that([](double value) { return value > 0.0 && value <= 1.0; },
                            "a factor above 0 and at most 1"));
    app.add_flag("--maintained", m.maintained,
                 "Each lamp's light times its own maintenance factor, 0.8 where none is set");
    app.add_option("--error", o.stop.error,
                   "Stop when each 95 % interval is this share of the mean wide to each side "
                   "(default: 0.05)")
        ->check(relative_error());
    app.add_option("--seconds", o.stop.seconds, "At most so long (default: 60)")->check(positive());
    app.add_option(
        "--require", m.require,
        "Required mean, mean/uniformity as 500/0.6, or with Ra of the luminaires as "
        "500/0.6/80; of UGR and DGP the most; exit status 5 where it is not met, 6 where "
        "that is not known after --seconds");
    app.add_flag("--json", m.json_to_stdout, "Print JSON");
}

}  // namespace raybundle
