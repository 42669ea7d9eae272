// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_service.h"

#include <spdlog/spdlog.h>

#include <charconv>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <sstream>

#include "report/bcf.h"
#include "report/floor_area.h"
#include "report/print_pdf.h"
#include "report/report_html.h"
#include "scene/gltf/gltf_loader.h"
#include "session/messages/scene_messages.h"
#include "session/unix_time.h"

namespace raybundle {
namespace {

constexpr const char* plain_text = "text/plain; charset=utf-8";
constexpr const char* scene_path = "/scene.glb";

/// "2026-06-21", or Unix time in ms.
double parse_since(const std::string& text) {
    std::tm t{};
    if (std::sscanf(text.c_str(), "%4d-%2d-%2d", &t.tm_year, &t.tm_mon, &t.tm_mday) == 3 &&
        t.tm_year >= 1970 && t.tm_year < 3000) {
        t.tm_year -= 1900;
        t.tm_mon -= 1;
        return 1000.0 * static_cast<double>(timegm(&t));
    }
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value >= 0.0 && value < 1e14 ? value : 0.0;
}

DocumentResult write_document(const ReportData& data, const DocumentRequest& request,
                              const std::stop_token& stop) {
    const ReportOptions options = report_options(request.query);
    if (request.path == "/report.html") {
        return {200, "text/html; charset=utf-8", report_html(data, options), "report.html"};
    }
    if (request.path == "/report.csv") {
        return {200, "text/csv; charset=utf-8", report_csv(data, options), "report.csv"};
    }
    if (request.path == "/report.json") {
        return {200, "application/json", report_json(data, options), "report.json"};
    }
    if (request.path == "/pins.bcf") {
        return {200, "application/octet-stream", write_bcf(data.pins, data.scene.name()),
                "pins.bcf"};
    }
    std::string reason;
    auto pdf = print_pdf(report_html(data, options), reason, stop);
    return pdf ? DocumentResult{200, "application/pdf", std::move(*pdf), "report.pdf"}
               : DocumentResult{501, plain_text, "There is no PDF: " + reason + "\n", {}};
}

/// What is wrong, without where the server keeps its files.
std::string without_folder(const SceneError& error) {
    std::string text = error.what();
    const std::string folder = std::filesystem::path(error.file()).parent_path().string() + "/";
    for (std::size_t at = text.find(folder); folder.size() > 1 && at != std::string::npos;
         at = text.find(folder, at)) {
        text.erase(at, folder.size());
    }
    return text;
}

/// A file that is too large is for `raybundle save`: several may be on their way at once.
DocumentResult write_scene(const SceneToSave& scene) {
    constexpr std::size_t most_bytes = std::size_t{512} << 20U;
    try {
        SavedFile file = save_scene(scene);
        if (file.bytes.size() > most_bytes) {
            return {413,
                    plain_text,
                    "The scene has more than 512 MiB: `raybundle save` writes it\n",
                    {}};
        }
        std::string notes;
        for (const std::string& note : file.notes) {
            notes += (notes.empty() ? "" : "; ") + note;
        }
        return {200, "model/gltf-binary", std::move(file.bytes), "scene.glb", notes};
    } catch (const SceneError& error) {
        return {409, plain_text, "The scene cannot be saved: " + without_folder(error) + "\n", {}};
    }
}

/// Of the rooms in which luminaires of a stated power are, m².
double floor_of_luminaires(const Scene& scene, const v1::Scene& described) {
    std::vector<glm::vec3> places;
    for (const v1::Light& light : described.lights()) {
        if (light.has_watts() && light.has_position()) {
            places.push_back(from_message(light.position()));
        }
    }
    return floor_area(scene, places);
}

}  // namespace

ReportOptions report_options(const std::string& query) {
    ReportOptions options;
    std::stringstream parts(query);
    for (std::string part; std::getline(parts, part, '&');) {
        const std::size_t equals = part.find('=');
        const std::string key = part.substr(0, equals);
        const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
        if (key == "lang") {
            options.german = value == "de";
        } else if (key == "unit") {
            options.foot_candles = value == "fc";
        } else if (key == "since") {
            options.since_ms = parse_since(value);
        } else if (key == "hours") {
            double hours = 0.0;
            std::from_chars(value.data(), value.data() + value.size(), hours);
            options.hours = hours > 0.0 && hours <= 8784.0 ? hours : options.hours;
        } else if (key == "area") {
            double area = 0.0;
            std::from_chars(value.data(), value.data() + value.size(), area);
            options.area = area > 0.0 && area <= 1e9 ? area : 0.0;
        }
    }
    return options;
}

ReportService::ReportService(const Parts& parts) : parts_(parts), thread_([this] { run(); }) {}

ReportService::~ReportService() {
    parts_.server.set_document_source(this, {});
    std::deque<std::pair<DocumentRequest, Done>> left;
    {
        const std::lock_guard lock(inbox_->mutex);
        inbox_->closed = true;
        left.swap(inbox_->waiting);
    }
    printing_.request_stop();
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        for (Job& job : jobs_) {
            left.emplace_back(std::move(job.request), std::move(job.done));
        }
        jobs_.clear();
    }
    wake_.notify_one();
    thread_.join();
    for (ReadPins& pins : read_pins_) {
        left.emplace_back(DocumentRequest(), std::move(pins.done));
    }
    for (auto& [request, done] : left) {
        done({503, plain_text, "Another scene is being opened; try again later\n", {}});
    }
}

/// Only a loop that runs takes over the requests: one that is being made may yet fail.
void ReportService::step() {
    if (!registered_) {
        registered_ = true;
        parts_.server.set_document_source(
            this, [inbox = inbox_, &server = parts_.server](DocumentRequest request, Done done) {
                const char* problem = nullptr;
                {
                    const std::lock_guard lock(inbox->mutex);
                    if (inbox->closed) {
                        problem = "Another scene is being opened; try again later\n";
                    } else if (inbox->unanswered >= max_documents) {
                        problem = "Other documents are being made; try again later\n";
                    } else {
                        ++inbox->unanswered;
                        inbox->waiting.emplace_back(
                            std::move(request), [inbox, done](DocumentResult result) {
                                {
                                    const std::lock_guard answered(inbox->mutex);
                                    --inbox->unanswered;
                                }
                                done(std::move(result));
                            });
                    }
                }
                if (problem != nullptr) {
                    done({503, plain_text, problem, {}});
                } else {
                    server.inbox().interrupt();
                }
            });
    }
    std::deque<std::pair<DocumentRequest, Done>> asked;
    {
        const std::lock_guard lock(inbox_->mutex);
        asked.swap(inbox_->waiting);
    }
    std::deque<ReadPins> read;
    {
        const std::lock_guard lock(mutex_);
        read.swap(read_pins_);
    }
    for (ReadPins& pins : read) {
        pins.done(parts_.review.import_pins(pins.topics));
    }
    std::shared_ptr<const ReportData> data;
    std::shared_ptr<const SceneToSave> scene;
    for (auto& [request, done] : asked) {
        Job job{nullptr, nullptr, std::move(request), std::move(done)};
        if (job.request.path == scene_path) {
            scene = scene ? scene
                          : std::make_shared<const SceneToSave>(
                                scene_to_save(parts_.scene.scene(), parts_.lighting.saved()));
            job.scene = scene;
        } else if (!job.request.put) {
            data = data ? data : collect();
            job.data = data;
        }
        {
            const std::lock_guard lock(mutex_);
            jobs_.push_back(std::move(job));
        }
        wake_.notify_one();
    }
}

std::shared_ptr<const ReportData> ReportService::collect() const {
    auto data = std::make_shared<ReportData>();
    data->server = "raybundle " RAYBUNDLE_VERSION;
    describe_scene(parts_.scene.scene(), &data->scene);
    data->scene.clear_objects();
    for (const Object& object : parts_.scene.scene().objects) {
        data->objects[object.id] = object.name;
    }
    data->floor_area = floor_of_luminaires(parts_.scene.scene(), data->scene);
    parts_.lighting.describe(&data->scene);
    data->epoch = parts_.scene.epoch();
    data->made_at_ms = unix_ms();
    for (const MeasureService::Zone& zone : parts_.measurements.zones()) {
        data->zones.push_back({zone.measure, zone.found, zone.request.lattice,
                               zone.request.lattice_size, zone.request.cells,
                               area_of(zone.request.outline)});
    }
    v1::Welcome told;
    parts_.measurements.requirements().fill(&told);
    data->requirements.assign(told.requirements().begin(), told.requirements().end());
    parts_.review.fill_welcome(&told);
    data->pins.assign(told.pins().begin(), told.pins().end());
    parts_.scene.log().records().fill(&data->changes);
    return data;
}

/// Reads an archive of pins, or writes a document. On the service's thread.
void ReportService::make(Job job) {
    DocumentResult result{500, plain_text, "The document could not be made\n", {}};
    try {
        if (job.scene) {
            result = write_scene(*job.scene);
        } else if (job.data) {
            result = write_document(*job.data, job.request, printing_.get_token());
        } else {
            std::string reason;
            if (auto topics = read_bcf(job.request.body, reason)) {
                const std::lock_guard lock(mutex_);
                read_pins_.push_back({std::move(*topics), std::move(job.done)});
                parts_.server.inbox().interrupt();
                return;
            }
            result = {400, plain_text, "The archive is refused: " + reason + "\n", {}};
        }
    } catch (const std::exception& error) {
        spdlog::error("{} could not be made: {}", job.request.path, error.what());
    }
    job.done(std::move(result));
}

void ReportService::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
        if (stop_) {
            return;
        }
        Job job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        make(std::move(job));
        lock.lock();
    }
}

}  // namespace raybundle
