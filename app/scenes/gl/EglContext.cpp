#include "app/scenes/gl/EglContext.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

namespace palp {

namespace {

EGLDisplay platformDisplay(EGLenum platform, void* native) {
  const auto display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return display != nullptr ? display(platform, native, nullptr) : EGL_NO_DISPLAY;
}

EGLDisplay deviceDisplay() {
  const auto devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  std::array<EGLDeviceEXT, 8> found{};
  EGLint count = 0;
  if (devices == nullptr || devices(static_cast<EGLint>(found.size()), found.data(), &count) == EGL_FALSE || count < 1)
    return EGL_NO_DISPLAY;
  return platformDisplay(EGL_PLATFORM_DEVICE_EXT, found[0]);
}

/// EGL_NO_CONTEXT where the display offers no desktop OpenGL.
EGLContext coreContext(EGLDisplay display) {
  constexpr std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                         EGL_NONE};
  constexpr std::array<EGLint, 7> core{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE ||
      eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
      eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count < 1)
    return EGL_NO_CONTEXT;
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, core.data());
  if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    eglDestroyContext(display, context);
    return EGL_NO_CONTEXT;
  }
  return context;
}

} // namespace

std::unique_ptr<EglContext> EglContext::make() {
  EGLDisplay device = deviceDisplay();
  if (EGLContext context = coreContext(device); context != EGL_NO_CONTEXT)
    return std::unique_ptr<EglContext>(new EglContext(device, context, "EGL device"));
  EGLDisplay surfaceless = platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
  if (EGLContext context = coreContext(surfaceless); context != EGL_NO_CONTEXT)
    return std::unique_ptr<EglContext>(new EglContext(surfaceless, context, "EGL surfaceless"));
  return nullptr;
}

EglContext::EglContext(void* display, void* context, std::string route)
    : display_(display), context_(context), route_(std::move(route)) {}

EglContext::~EglContext() {
  if (isCurrent()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void EglContext::makeCurrent() {
  if (!isCurrent()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

bool EglContext::isCurrent() const {
  return eglGetCurrentContext() == context_;
}

} // namespace palp
