// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "net/server.h"
#include "report/report_data.h"
#include "scene/gltf/saved/scene_to_save.h"
#include "session/changes/lighting_scenes.h"
#include "session/live_scene.h"
#include "session/measure/measure_service.h"
#include "session/review/review_service.h"

namespace raybundle {

/// Makes the documents that are asked for over HTTP: report.html, .pdf, .csv, .json, pins.bcf and
/// scene.glb, the scene as it has been edited; takes pins in. The render thread copies what is
/// known, a thread of its own writes it.
class ReportService {
  public:
    /// Documents that are asked for and not made: with those whose askers have gone, which
    /// HttpDocuments counts no more.
    static constexpr std::size_t max_documents = 8;

    struct Parts {
        const LiveScene& scene;
        const MeasureService& measurements;
        const LightingScenes& lighting;
        ReviewService& review;
        Server& server;
    };
    explicit ReportService(const Parts& parts);
    ~ReportService();
    ReportService(const ReportService&) = delete;
    ReportService& operator=(const ReportService&) = delete;

    /// Looks at what has been asked for.
    void step();

  private:
    using Done = std::function<void(DocumentResult)>;
    /// What all threads share with the network's: it may outlive the service.
    struct Inbox {
        std::mutex mutex;
        std::deque<std::pair<DocumentRequest, Done>> waiting;
        std::size_t unanswered = 0;  ///< of all that wait or are being made
        bool closed = false;
    };
    /// Pins of an archive that has been read, for the render thread to take in.
    struct ReadPins {
        std::vector<v1::PinChanged> topics;
        Done done;
    };
    struct Job {
        std::shared_ptr<const ReportData> data;
        std::shared_ptr<const SceneToSave> scene;  ///< both null: pins are to be read
        DocumentRequest request;
        Done done;
    };

    [[nodiscard]] std::shared_ptr<const ReportData> collect() const;
    void run();
    void make(Job job);

    Parts parts_;
    bool registered_ = false;
    std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Job> jobs_;
    std::deque<ReadPins> read_pins_;
    bool stop_ = false;
    std::stop_source printing_;
    std::thread thread_;
};

/// Options of a query as "lang=de&unit=fc&since=2026-06-21&hours=2500&area=40"; what is not known
/// is left out.
ReportOptions report_options(const std::string& query);

}  // namespace raybundle
