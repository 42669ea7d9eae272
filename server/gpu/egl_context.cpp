// SPDX-License-Identifier: Apache-2.0
#include "gpu/egl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <spdlog/spdlog.h>

#include <array>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include "gpu/binding_counts.h"

namespace raybundle {

namespace {

/// Contexts of the process by display: a display is one for all of its threads, and whoever ends it
/// ends it for all.
class DisplayUses {
  public:
    bool begin(EGLDisplay display) {
        const std::lock_guard lock(mutex_);
        if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
            return false;
        }
        ++uses_[display];
        return true;
    }
    void end(EGLDisplay display) {
        const std::lock_guard lock(mutex_);
        if (--uses_[display] == 0) {
            eglTerminate(display);
        }
    }

  private:
    std::mutex mutex_;
    std::map<EGLDisplay, int> uses_;
};

DisplayUses& display_uses() {
    static DisplayUses uses;
    return uses;
}

bool is_software(std::string_view renderer) {
    return renderer.find("llvmpipe") != std::string_view::npos ||
           renderer.find("softpipe") != std::string_view::npos;
}

}  // namespace

struct EglContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string renderer;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (display == EGL_NO_DISPLAY) {
            return;
        }
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) {
            eglDestroyContext(display, context);
        }
        display_uses().end(display);
    }
};

EglContext::EglContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;
EglContext::~EglContext() = default;

const std::string& EglContext::renderer() const {
    return impl_->renderer;
}

bool EglContext::is_software() const {
    return raybundle::is_software(impl_->renderer);
}

bool is_software_renderer() {
    return is_software(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
}

namespace {

constexpr int max_devices = 32;

std::vector<EGLDeviceEXT> query_devices() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
        return {};
    }
    EGLDeviceEXT devices[max_devices];
    EGLint count = 0;
    if (eglQueryDevicesEXT(max_devices, devices, &count) == EGL_FALSE) {
        return {};
    }
    return {devices, devices + count};
}

void GLAPIENTRY log_gl_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei,
                               const GLchar* message, const void*) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION || source == GL_DEBUG_SOURCE_APPLICATION) {
        return;
    }
    const auto level = type == GL_DEBUG_TYPE_ERROR          ? spdlog::level::err
                       : severity == GL_DEBUG_SEVERITY_HIGH ? spdlog::level::warn
                       : type == GL_DEBUG_TYPE_PERFORMANCE  ? spdlog::level::debug
                                                            : spdlog::level::info;
    spdlog::log(level, "GL message {}: {}", id, message);
}

void enable_debug_output(bool synchronous) {
    glEnable(GL_DEBUG_OUTPUT);
    if (synchronous) {
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    }
    glDebugMessageCallback(log_gl_message, nullptr);
}

/// A context that says when it has been reset, where the driver can tell.
EGLContext create_context(EGLDisplay display) {
    constexpr std::size_t notification = 6;  // where it begins
    std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                        EGL_LOSE_CONTEXT_ON_RESET,
                                        EGL_NONE};
    const auto create = [&] {
        return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    };
    const EGLContext telling = create();
    attributes[notification] = EGL_NONE;
    return telling != EGL_NO_CONTEXT ? telling : create();
}

/// Opens a display and makes a context current on it; nullptr and a reason where that fails.
std::unique_ptr<EglContext::Impl> open(EGLenum platform, void* native, std::string& reason) {
    // Without any vendor's library epoxy would abort at the first call.
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
        reason = "no EGL driver is installed";
        return nullptr;
    }
    auto impl = std::make_unique<EglContext::Impl>();
    impl->display = eglGetPlatformDisplayEXT(platform, native, nullptr);
    if (impl->display == EGL_NO_DISPLAY) {
        reason = "no display";
        return nullptr;
    }
    if (!display_uses().begin(impl->display)) {
        impl->display = EGL_NO_DISPLAY;
        reason = "eglInitialize failed";
        return nullptr;
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        reason = "the driver offers no desktop OpenGL";
        return nullptr;
    }
    impl->context = create_context(impl->display);
    if (impl->context == EGL_NO_CONTEXT) {
        reason = "no OpenGL 4.5 core context";
        return nullptr;
    }
    if (eglMakeCurrent(impl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl->context) == EGL_FALSE) {
        reason = "a context without a surface cannot be made current";
        return nullptr;
    }
    impl->renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return impl;
}

bool is_software_device(EGLDeviceEXT device) {
    const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return extensions != nullptr &&
           std::string_view(extensions).find("software") != std::string_view::npos;
}

std::string try_device(EGLDeviceEXT device, std::unique_ptr<EglContext::Impl>& result) {
    std::string reason;
    result = open(EGL_PLATFORM_DEVICE_EXT, device, reason);
    return reason;
}

std::unique_ptr<EglContext::Impl> open_chosen_device(int gpu) {
    const auto devices = query_devices();
    if (gpu >= static_cast<int>(devices.size())) {
        throw GpuError("--gpu " + std::to_string(gpu) + ": there are " +
                       std::to_string(devices.size()) + " EGL devices; see --list-gpus");
    }
    std::unique_ptr<EglContext::Impl> result;
    const std::string reason = try_device(devices[static_cast<std::size_t>(gpu)], result);
    if (!result) {
        throw GpuError("--gpu " + std::to_string(gpu) + ": " + reason + "; see --list-gpus");
    }
    return result;
}

std::unique_ptr<EglContext::Impl> open_first_usable(std::string& tried) {
    std::unique_ptr<EglContext::Impl> result;
    const auto devices = query_devices();
    for (const bool software : {false, true}) {
        for (std::size_t i = 0; i < devices.size(); ++i) {
            if (is_software_device(devices[i]) != software) {
                continue;
            }
            const std::string reason = try_device(devices[i], result);
            if (result) {
                return result;
            }
            tried += "; EGL device " + std::to_string(i) + ": " + reason;
        }
    }
    std::string reason;
    result = open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, reason);
    if (!result) {
        tried += "; Mesa surfaceless: " + reason;
    }
    return result;
}

}  // namespace

EglContext create_egl_context(const EglSettings& settings) {
    std::string tried;
    auto impl = settings.gpu >= 0 ? open_chosen_device(settings.gpu) : open_first_usable(tried);
    if (!impl) {
        throw GpuError("no OpenGL 4.5 context without a window can be created (tried" + tried +
                       "). Install a GPU driver with EGL, or Mesa: apt install libegl1 "
                       "libegl-mesa0 libgl1-mesa-dri");
    }
    enable_debug_output(settings.debug);
    check_bindings(bindings_needed(), bindings_of_driver());
    if (epoxy_has_gl_extension("GL_KHR_parallel_shader_compile")) {
        glMaxShaderCompilerThreadsKHR(std::numeric_limits<GLuint>::max());  // as many as it likes
    }
    // Depth from 1 (near) to 0 (far): keeps relative precision over the whole range.
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    spdlog::info("OpenGL on {}", impl->renderer);
    return EglContext(std::move(impl));
}

std::vector<GpuDevice> list_gpu_devices() {
    std::vector<GpuDevice> result;
    for (EGLDeviceEXT device : query_devices()) {
        std::unique_ptr<EglContext::Impl> impl;
        const std::string reason = try_device(device, impl);
        result.push_back(
            {static_cast<int>(result.size()), impl ? impl->renderer : reason, impl != nullptr});
    }
    return result;
}

}  // namespace raybundle
