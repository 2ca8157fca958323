#include "app/scenes/gl/OffscreenWindow.h"

#include "app/scenes/gl/EglContext.h"
#include "model/base/Error.h"

#include <GL/glew.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace palp {

namespace {

/// Debian's GLEW is built for GLX: on EGL its glewInit ends with "no GLX display" although every entry point was
/// loaded by then, and VTK would refuse the context.
class EglRenderWindow : public vtkGenericOpenGLRenderWindow {
public:
  static EglRenderWindow* New();
  vtkTypeMacro(EglRenderWindow, vtkGenericOpenGLRenderWindow)

      void OpenGLInitContext() override {
    if (!Initialized) {
      glewExperimental = GL_TRUE;
      const GLenum result = glewInit();
      if (result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY) {
        GlewInitValid = true;
        Initialized = true; // the base class then skips its own glewInit
      }
    }
    Superclass::OpenGLInitContext();
  }
};

vtkStandardNewMacro(EglRenderWindow)

    void answerVtk(vtkObject*, unsigned long event, void* context, void* answer) {
  auto& egl = *static_cast<EglContext*>(context);
  if (event == vtkCommand::WindowMakeCurrentEvent) egl.makeCurrent();
  if (event == vtkCommand::WindowIsCurrentEvent) *static_cast<bool*>(answer) = egl.isCurrent();
}

vtkSmartPointer<vtkRenderWindow> eglWindow(EglContext& egl) {
  auto window = vtkSmartPointer<EglRenderWindow>::New();
  vtkNew<vtkCallbackCommand> answer;
  answer->SetCallback(answerVtk);
  answer->SetClientData(&egl);
  window->AddObserver(vtkCommand::WindowMakeCurrentEvent, answer);
  window->AddObserver(vtkCommand::WindowIsCurrentEvent, answer);
  egl.makeCurrent();
  window->SetOwnContext(0);
  window->SetFrameBlitModeToNoBlit();
  window->SetReadyForRendering(true);
  window->SetMapped(1);
  window->SetForceMaximumHardwareLineWidth(1);
  window->OpenGLInitContext();
  return window;
}

vtkSmartPointer<vtkRenderWindow> xWindow() {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  return window;
}

} // namespace

struct OffscreenWindow::State {
  std::unique_ptr<EglContext> egl; ///< null on the X route
  vtkSmartPointer<vtkRenderWindow> window;
  std::string route;
};

OffscreenWindow::OffscreenWindow() : state_(std::make_unique<State>()) {
  state_->egl = EglContext::make();
  if (!state_->egl && std::getenv("DISPLAY") == nullptr)
    throw Error("no picture can be drawn: neither EGL nor an X display is there; install libegl1 and libgl1-mesa-dri");
  state_->window = state_->egl ? eglWindow(*state_->egl) : xWindow();
  state_->window->SetMultiSamples(0); // costs 80 ms a frame on a software renderer
  state_->route = state_->egl ? state_->egl->route() : "offscreen X";
}

OffscreenWindow::~OffscreenWindow() {
  if (state_->egl) state_->egl->makeCurrent();
  state_->window->Finalize();
  state_->window = nullptr;
}

vtkRenderWindow* OffscreenWindow::vtk() const {
  return state_->window;
}

const std::string& OffscreenWindow::route() const {
  return state_->route;
}

void OffscreenWindow::setSize(int width, int height) {
  state_->window->SetSize(std::max(width, 1), std::max(height, 1));
}

void OffscreenWindow::render() {
  if (state_->egl) state_->egl->makeCurrent();
  state_->window->Render();
}

Picture OffscreenWindow::picture() const {
  const int* size = state_->window->GetSize();
  const auto width = static_cast<std::size_t>(size[0]);
  const auto height = static_cast<std::size_t>(size[1]);
  std::vector<std::uint8_t> bgra(4 * width * height);
  copyBgra(bgra.data(), 4 * width);
  return pictureOfBgra(bgra, size[0], size[1]);
}

void OffscreenWindow::copyBgra(std::uint8_t* pixels, std::size_t stride) const {
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(state_->window);
  if (state_->egl) state_->egl->makeCurrent();
  const int* size = window->GetSize();
  const auto row = 4 * static_cast<std::size_t>(size[0]);
  const auto height = static_cast<std::size_t>(size[1]);
  window->GetState()->PushReadFramebufferBinding();
  vtkOpenGLFramebufferObject* drawn = window->GetDisplayFramebuffer();
  drawn->Bind(GL_READ_FRAMEBUFFER);
  drawn->ActivateReadBuffer(0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(stride / 4));
  glReadPixels(0, 0, size[0], size[1], GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  window->GetState()->PopReadFramebufferBinding();
  // OpenGL's first row is the lowest; turned over in place, for a second buffer costs a millisecond a frame.
  for (std::size_t low = height - 1, high = 0; high < low; ++high, --low)
    std::swap_ranges(pixels + high * stride, pixels + high * stride + row, pixels + low * stride);
}

Picture drawOnce(vtkRenderer* renderer, int width, int height) {
  requireDrawable(width, height);
  OffscreenWindow window;
  window.setSize(width, height);
  window.vtk()->AddRenderer(renderer);
  window.render();
  Picture picture = window.picture();
  window.vtk()->RemoveRenderer(renderer);
  return picture;
}

} // namespace palp
