// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace raybundle {

/// Names a group of GL commands for its lifetime: in debuggers and, while profiling, in the
/// profile.
class GlScope {
  public:
    explicit GlScope(const char* label);
    ~GlScope();
    GlScope(const GlScope&) = delete;
    GlScope& operator=(const GlScope&) = delete;

  private:
    const char* label_;
    double start_ = 0.0;  // seconds; only while profiling
};

/// What the scopes of one label have cost.
struct GlProfileEntry {
    std::string label;
    std::size_t calls = 0;
    double milliseconds = 0.0;
};

/// From now on every scope waits for the GL to finish, and its time is counted. Scopes must not
/// nest while profiling. For the thread of the GL context only.
void start_gl_profile();
/// Ends it. The most expensive label first.
std::vector<GlProfileEntry> stop_gl_profile();

}  // namespace raybundle
