#pragma once

#include <memory>
#include <string>

namespace palp {

/// An OpenGL 3.2 core context with no surface: of an EGL device, else Mesa's surfaceless platform.
class EglContext {
public:
  /// Null where EGL offers neither.
  static std::unique_ptr<EglContext> make();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent();
  [[nodiscard]] bool isCurrent() const;
  [[nodiscard]] const std::string& route() const { return route_; }

private:
  EglContext(void* display, void* context, std::string route);
  void* display_; ///< EGLDisplay; shared by the process, never terminated
  void* context_; ///< EGLContext, owned
  std::string route_;
};

} // namespace palp
