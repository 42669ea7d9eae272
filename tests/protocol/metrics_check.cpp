// SPDX-License-Identifier: Apache-2.0
#include "metrics_check.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace raybundle {
namespace {

/// Units that Prometheus does not want: seconds, bytes and ratios are the base units.
constexpr std::string_view kOtherUnits[] = {"ms",        "milliseconds", "us",   "microseconds",
                                            "minutes",   "hours",        "kb",   "mb",
                                            "kilobytes", "megabytes",    "bits", "percent"};

class Checker {
  public:
    std::vector<std::string> run(std::string_view text) {
        if (text.empty() || text.back() != '\n') {
            problems_.push_back("the last line does not end");
        }
        std::istringstream lines{std::string(text)};
        for (std::string line; std::getline(lines, line);) {
            line.starts_with("# HELP ")   ? on_help(line.substr(7))
            : line.starts_with("# TYPE ") ? on_type(line.substr(7))
                                          : on_sample(line);
        }
        for (const auto& [name, family] : families_) {
            check_family(name, family);
        }
        return problems_;
    }

  private:
    struct Family {
        int helps = 0;
        int types = 0;
        int samples = 0;
        std::string type;
        std::string help;
    };

    void complain(const std::string& name, const std::string& problem) {
        problems_.push_back(name + ": " + problem);
    }

    void on_help(const std::string& rest) {
        const std::string name = rest.substr(0, rest.find(' '));
        enter(name);
        Family& family = families_[name];
        ++family.helps;
        family.help = rest.size() > name.size() ? rest.substr(name.size() + 1) : "";
    }

    void on_type(const std::string& rest) {
        const std::string name = rest.substr(0, rest.find(' '));
        enter(name);
        Family& family = families_[name];
        ++family.types;
        family.type = rest.size() > name.size() ? rest.substr(name.size() + 1) : "";
    }

    /// A family's lines stand together.
    void enter(const std::string& name) {
        if (name == current_) {
            return;
        }
        if (!left_.insert(name).second) {
            complain(name, "its lines do not stand together");
        }
        current_ = name;
    }

    void on_sample(const std::string& line) {
        static const std::regex kSample(
            R"(([a-zA-Z_:][a-zA-Z0-9_:]*)(\{([a-zA-Z_][a-zA-Z0-9_]*="[^"\\\n]*",?)*\})? (\S+))");
        std::smatch match;
        if (!std::regex_match(line, match, kSample)) {
            complain(line, "is no sample");
            return;
        }
        const std::string name = match[1];
        Family& family = families_[current_];
        ++family.samples;
        const bool part =
            family.type == "summary" && (name == current_ + "_sum" || name == current_ + "_count");
        if (name != current_ && !part) {
            complain(name, "stands below " + current_);
        }
        if (family.types == 0) {
            complain(name, "comes before its TYPE");
        }
        if (!series_.insert(name + match[2].str()).second) {
            complain(line, "is there twice");
        }
        check_labels(name, match[2], family);
        check_value(line, match[4]);
    }

    void check_labels(const std::string& name, const std::string& labels, const Family& family) {
        if (labels.find("quantile=") != std::string::npos && family.type != "summary") {
            complain(name, "has quantiles and is no summary");
        }
    }

    void check_value(const std::string& line, const std::string& value) {
        double number = 0.0;
        const auto [rest, error] =
            std::from_chars(value.data(), value.data() + value.size(), number);
        const bool named = value == "NaN" || value == "+Inf" || value == "-Inf";
        if (!named && (!std::isfinite(number) || error != std::errc() ||
                       rest != value.data() + value.size())) {
            complain(line, "has no number");
        }
    }

    void check_family(const std::string& name, const Family& family) {
        const bool total = name.ends_with("_total");
        if (family.helps != 1 || family.types != 1) {
            complain(name, "needs HELP and TYPE once");
        }
        if (family.help.empty()) {
            complain(name, "has no help");
        }
        if (family.samples == 0) {
            complain(name, "has no sample");
        }
        if (family.type != "counter" && family.type != "gauge" && family.type != "summary") {
            complain(name, "has the type '" + family.type + "'");
        }
        if (total != (family.type == "counter")) {
            complain(name, "counters end with _total, and nothing else does");
        }
        for (const char* suffix : {"_sum", "_count", "_bucket"}) {
            if (name.ends_with(suffix)) {
                complain(name, std::string("ends with ") + suffix);
            }
        }
        if (!std::regex_match(name, std::regex("[a-z][a-z0-9_]*")) ||
            name.find("__") != std::string::npos) {
            complain(name, "is not in snake_case");
        }
        for (const std::string& word : words(name)) {
            if (std::find(std::begin(kOtherUnits), std::end(kOtherUnits), word) !=
                std::end(kOtherUnits)) {
                complain(name, word + " is no base unit");
            }
            if (word == "counter" || word == "gauge" || word == "summary") {
                complain(name, "has its type in its name");
            }
        }
    }

    static std::vector<std::string> words(const std::string& name) {
        std::vector<std::string> result;
        std::istringstream parts(name);
        for (std::string word; std::getline(parts, word, '_');) {
            result.push_back(word);
        }
        return result;
    }

    std::vector<std::string> problems_;
    std::map<std::string, Family> families_;
    std::set<std::string> left_;
    std::set<std::string> series_;
    std::string current_;
};

}  // namespace

std::vector<std::string> metrics_problems(std::string_view text) {
    return Checker().run(text);
}

}  // namespace raybundle
