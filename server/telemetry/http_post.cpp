// SPDX-License-Identifier: Apache-2.0
#include "telemetry/http_post.h"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace raybundle {
namespace {

constexpr int slice_ms = 50;  ///< of a wait, after which the deadline is asked for again

template <auto free>
struct Deleter {
    void operator()(auto* owned) const { free(owned); }
};
using Transfer = std::unique_ptr<CURL, Deleter<&curl_easy_cleanup>>;
using Transfers = std::unique_ptr<CURLM, Deleter<&curl_multi_cleanup>>;
using HeaderList = std::unique_ptr<curl_slist, Deleter<&curl_slist_free_all>>;

void add_header(HeaderList& list, const std::string& line) {
    curl_slist* const longer = curl_slist_append(list.get(), line.c_str());
    if (longer == nullptr) {
        throw std::bad_alloc();
    }
    static_cast<void>(list.release());
    list.reset(longer);
}

std::size_t pass_over(char* /*bytes*/, std::size_t size, std::size_t count, void* /*unused*/) {
    return size * count;
}

/// How the only transfer of `handles` has ended.
CURLcode outcome(CURLM* handles) {
    int waiting = 0;
    const CURLMsg* const message = curl_multi_info_read(handles, &waiting);
    return message != nullptr && message->msg == CURLMSG_DONE ? message->data.result
                                                              : CURLE_RECV_ERROR;
}

}  // namespace

HttpPost::HttpPost(HttpUrl url, Headers headers, std::string ca_file)
    : url_(std::move(url)), headers_(std::move(headers)), ca_file_(std::move(ca_file)) {
    static const CURLcode initialised = curl_global_init(CURL_GLOBAL_DEFAULT);
    if (initialised != CURLE_OK) {
        throw std::runtime_error(std::string("libcurl: ") + curl_easy_strerror(initialised));
    }
    if (url_.tls && !ca_file_.empty() && !std::ifstream(ca_file_)) {
        throw std::runtime_error(ca_file_ + ": cannot be read");
    }
}

PostResult HttpPost::send(std::string_view content_type, std::string_view body,
                          const Deadline& deadline) const {
    HeaderList headers;
    add_header(headers, "Content-Type: " + std::string(content_type));
    for (const auto& [name, value] : headers_) {
        // A header without a value ends with a semicolon in libcurl.
        add_header(headers, name + (value.empty() ? ";" : ": " + value));
    }
    std::array<char, CURL_ERROR_SIZE> problem{};
    const Transfer post(curl_easy_init());
    const Transfers handles(curl_multi_init());
    if (!post || !handles) {
        throw std::bad_alloc();
    }
    const auto set = [&post](CURLoption option, auto value) {
        curl_easy_setopt(post.get(), option, value);
    };
    set(CURLOPT_URL, url_.text().c_str());
    set(CURLOPT_PROXY, "");  // none of the environment: collectors stand nearby
    set(CURLOPT_HTTPHEADER, headers.get());
    set(CURLOPT_USERAGENT, "raybundle/" RAYBUNDLE_VERSION);
    set(CURLOPT_POSTFIELDS, body.data());
    set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
    set(CURLOPT_WRITEFUNCTION, &pass_over);
    set(CURLOPT_ERRORBUFFER, problem.data());
    set(CURLOPT_SSLVERSION, long{CURL_SSLVERSION_TLSv1_2});
    set(CURLOPT_NOSIGNAL, 1L);
    set(CURLOPT_QUICK_EXIT, 1L);  // a name that is being looked up holds up nobody
    if (!ca_file_.empty()) {
        set(CURLOPT_CAINFO, ca_file_.c_str());
        set(CURLOPT_CAPATH, nullptr);
    }
    curl_multi_add_handle(handles.get(), post.get());
    PostResult result;
    for (int running = 1;;) {
        curl_multi_perform(handles.get(), &running);
        if (running == 0) {
            break;
        }
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline() - Clock::now());
        if (left.count() <= 0) {
            result.problem = "no answer in time";
            break;
        }
        curl_multi_poll(handles.get(), nullptr, 0,
                        static_cast<int>(std::min<long>(left.count(), slice_ms)), nullptr);
    }
    if (result.problem.empty()) {
        const CURLcode code = outcome(handles.get());
        long status = 0;
        curl_easy_getinfo(post.get(), CURLINFO_RESPONSE_CODE, &status);
        result.status = code == CURLE_OK ? static_cast<int>(status) : 0;
        if (code != CURLE_OK) {
            result.problem = problem[0] != '\0' ? problem.data() : curl_easy_strerror(code);
        }
    }
    curl_multi_remove_handle(handles.get(), post.get());
    return result;
}

}  // namespace raybundle
