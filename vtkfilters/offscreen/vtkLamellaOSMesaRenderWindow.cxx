#include "vtkLamellaOSMesaRenderWindow.h"

#include "vtkLamellaOSMesaLibrary.h"
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkLamellaOSMesaRenderWindow);

vtkLamellaOSMesaRenderWindow::~vtkLamellaOSMesaRenderWindow()
{
  this->Finalize();
}

bool vtkLamellaOSMesaRenderWindow::IsAvailable(std::string& why)
{
  const auto& library = vtkLamellaOSMesaLibrary::Get();
  void* context = library.CreateContext(why);
  if (!context)
  {
    return false;
  }
  library.DestroyContext(context);
  return true;
}

bool vtkLamellaOSMesaRenderWindow::CreateContext(std::string& why)
{
  this->Context = vtkLamellaOSMesaLibrary::Get().CreateContext(why);
  return this->Context != nullptr;
}

void vtkLamellaOSMesaRenderWindow::DestroyContext()
{
  vtkLamellaOSMesaLibrary::Get().DestroyContext(this->Context);
  this->Context = nullptr;
}

bool vtkLamellaOSMesaRenderWindow::BindContext()
{
  return vtkLamellaOSMesaLibrary::Get().Bind(this->Context, this->Buffer, BufferSide);
}

void vtkLamellaOSMesaRenderWindow::UnbindContext()
{
  vtkLamellaOSMesaLibrary::Get().Unbind();
}

bool vtkLamellaOSMesaRenderWindow::IsCurrent()
{
  return this->Context && vtkLamellaOSMesaLibrary::Get().IsBound(this->Context);
}
