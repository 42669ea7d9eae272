// SPDX-License-Identifier: Apache-2.0
#include "gpu/gl_scope.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>

namespace raybundle {

namespace {

using Profile = std::map<std::string, GlProfileEntry>;

std::optional<Profile>& running_profile() {
    thread_local std::optional<Profile> profile;
    return profile;
}

double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

GlScope::GlScope(const char* label) : label_(label) {
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, label);
    if (running_profile()) {
        glFinish();
        start_ = now_seconds();
    }
}

GlScope::~GlScope() {
    glPopDebugGroup();
    if (std::optional<Profile>& profile = running_profile()) {
        glFinish();
        GlProfileEntry& entry = (*profile)[label_];
        entry.label = label_;
        ++entry.calls;
        entry.milliseconds += 1e3 * (now_seconds() - start_);
    }
}

void start_gl_profile() {
    running_profile().emplace();
}

std::vector<GlProfileEntry> stop_gl_profile() {
    std::vector<GlProfileEntry> entries;
    for (auto& [label, entry] : running_profile().value_or(Profile{})) {
        entries.push_back(entry);
    }
    running_profile().reset();
    std::sort(entries.begin(), entries.end(), [](const GlProfileEntry& a, const GlProfileEntry& b) {
        return a.milliseconds > b.milliseconds;
    });
    return entries;
}

}  // namespace raybundle
