// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace raybundle {

/// A request for a document that the session makes of itself, or takes in.
struct DocumentRequest {
    std::string path;   ///< decoded, without query
    std::string query;  ///< decoded, "lang=de&unit=fc"
    bool put = false;
    std::string body;  ///< of a PUT
};

struct DocumentResult {
    int status = 200;
    const char* content_type = "text/plain; charset=utf-8";  ///< text that lives for ever
    std::string body;
    std::string file_name;  ///< for who saves it; empty: none
    std::string notes{};    ///< what it lacks, in words
};

/// Makes documents. Called on the network thread, returns at once; `done` is called once, on any
/// thread, unless the program ends before.
using DocumentSource =
    std::function<void(DocumentRequest request, std::function<void(DocumentResult)> done)>;

/// Whether a path is one of documents.
inline bool is_document(const std::string& path) {
    return path == "/report.html" || path == "/report.pdf" || path == "/report.csv" ||
           path == "/report.json" || path == "/pins.bcf" || path == "/scene.glb";
}

}  // namespace raybundle
