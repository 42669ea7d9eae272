// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace raybundle {

/// No OpenGL 4.5 context can be had; the text says what was tried and what a user can do. Exit
/// status 4.
class GpuError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The driver has refused a command: a fault of this program, whatever the machine. Exit status 1.
class GlError : public GpuError {
    using GpuError::GpuError;
};

/// An EGL device that could run the server.
struct GpuDevice {
    int index = 0;         ///< what --gpu takes
    std::string renderer;  ///< GL_RENDERER, or why the device cannot be used
    bool usable = false;
};

/// A current, surfaceless OpenGL 4.5 core context on the calling thread. One thread owns it.
class EglContext {
  public:
    struct Impl;
    explicit EglContext(std::unique_ptr<Impl> impl);
    EglContext(EglContext&&) noexcept;
    EglContext& operator=(EglContext&&) noexcept;
    ~EglContext();

    [[nodiscard]] const std::string& renderer() const;
    /// is_software_renderer() of this context, current or not.
    [[nodiscard]] bool is_software() const;

  private:
    std::unique_ptr<Impl> impl_;
};

/// True where Mesa's software rasteriser is behind the current context: shaders then run on the
/// server's own few cores.
bool is_software_renderer();

struct EglSettings {
    int gpu = -1;  ///< index of list_gpu_devices(), -1: first usable, hardware before software
    bool debug = false;  ///< synchronous GL debug output
};

/// Creates the context: EGL device platform first, else Mesa surfaceless. Throws GpuError.
EglContext create_egl_context(const EglSettings& settings = {});

/// All EGL devices in the order of --gpu. Empty where the device platform is missing.
std::vector<GpuDevice> list_gpu_devices();

}  // namespace raybundle
