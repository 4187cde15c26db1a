#include "vtkLamellaOSMesaLibrary.h"

#include <dlfcn.h>

namespace
{
// From GL/gl.h and GL/osmesa.h, whose gl* prototypes clash with GLEW's.
constexpr unsigned int GlUnsignedByte = 0x1401;
constexpr int OsmesaFormat = 0x22, OsmesaRgba = 0x1908;
constexpr int OsmesaDepthBits = 0x30, OsmesaStencilBits = 0x31, OsmesaAccumBits = 0x32;
constexpr int OsmesaProfile = 0x33, OsmesaCoreProfile = 0x34;
constexpr int OsmesaContextMajor = 0x36, OsmesaContextMinor = 0x37;

void* Open(std::initializer_list<const char*> names)
{
  for (const char* name : names)
  {
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL))
    {
      return library;
    }
  }
  return nullptr;
}

template <class Function>
bool Find(void* library, const char* name, Function& function)
{
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}
}

const vtkLamellaOSMesaLibrary& vtkLamellaOSMesaLibrary::Get()
{
  static const auto* library = new vtkLamellaOSMesaLibrary; // windows may outlive static objects
  return *library;
}

vtkLamellaOSMesaLibrary::vtkLamellaOSMesaLibrary()
{
  if (this->Load())
  {
    this->Why.clear();
  }
}

bool vtkLamellaOSMesaLibrary::Load()
{
  this->Why = "libOSMesa.so is missing (install libosmesa6)";
  void* osmesa = Open({ "libOSMesa.so.8", "libOSMesa.so.6" });
  if (!osmesa)
  {
    return false;
  }
  this->Why = "libGLdispatch.so.0 is missing (install libglvnd0)";
  void* dispatch = Open({ "libGLdispatch.so.0" });
  if (!dispatch)
  {
    return false;
  }
  this->Why = "libOSMesa or libGLdispatch lacks a function (install libosmesa6 and libglvnd0)";
  if (!Find(osmesa, "OSMesaCreateContextAttribs", this->OSMesaCreateContextAttribs) ||
    !Find(osmesa, "OSMesaDestroyContext", this->OSMesaDestroyContext) ||
    !Find(osmesa, "OSMesaMakeCurrent", this->OSMesaMakeCurrent) ||
    !Find(osmesa, "OSMesaGetCurrentContext", this->OSMesaGetCurrentContext) ||
    !Find(osmesa, "OSMesaGetProcAddress", this->OSMesaGetProcAddress) ||
    !Find(dispatch, "__glDispatchGetABIVersion", this->GetABIVersion) ||
    !Find(dispatch, "__glDispatchInit", this->Init) ||
    !Find(dispatch, "__glDispatchNewVendorID", this->NewVendorID) ||
    !Find(dispatch, "__glDispatchCreateTable", this->CreateTable) ||
    !Find(dispatch, "__glDispatchMakeCurrent", this->MakeCurrent) ||
    !Find(dispatch, "__glDispatchLoseCurrent", this->LoseCurrent) ||
    !Find(dispatch, "__glDispatchGetCurrentThreadState", this->GetCurrentThreadState))
  {
    return false;
  }
  if (this->GetABIVersion() != 1)
  {
    this->Why = "libGLdispatch has ABI version " + std::to_string(this->GetABIVersion()) +
      ", only version 1 is known (use egl)";
    return false;
  }
  this->Init();
  this->Vendor = this->NewVendorID();
  this->Dispatch = this->CreateTable(
    [](const char* name, void* self)
    {
      auto* library = static_cast<vtkLamellaOSMesaLibrary*>(self);
      return reinterpret_cast<void*>(library->OSMesaGetProcAddress(name));
    },
    this);
  this->Why = "libGLdispatch gave no dispatch table";
  return this->Dispatch != nullptr;
}

void* vtkLamellaOSMesaLibrary::CreateContext(std::string& why) const
{
  static const int attributes[] = { OsmesaFormat, OsmesaRgba, OsmesaDepthBits, 24,
    OsmesaStencilBits, 0, OsmesaAccumBits, 0, OsmesaProfile, OsmesaCoreProfile, OsmesaContextMajor,
    3, OsmesaContextMinor, 2, 0 };
  why = this->Why;
  if (!why.empty())
  {
    return nullptr;
  }
  void* context = this->OSMesaCreateContextAttribs(attributes, nullptr);
  if (!context)
  {
    why = "OSMesa gives no OpenGL 3.2 context (install libosmesa6 22 or later)";
  }
  return context;
}

void vtkLamellaOSMesaLibrary::DestroyContext(void* context) const
{
  this->OSMesaDestroyContext(context);
}

vtkLamellaOSMesaLibrary::ThreadState& vtkLamellaOSMesaLibrary::GetThreadState()
{
  // Ended by the dispatcher, which may hold it longer than this library's thread-local storage lives.
  static thread_local auto* state =
    new ThreadState{ 2, [](ThreadState* ended) { delete ended; }, nullptr };
  return *state;
}

bool vtkLamellaOSMesaLibrary::Bind(void* context, unsigned char* buffer, int side) const
{
  if (!this->OSMesaMakeCurrent(context, buffer, GlUnsignedByte, side, side))
  {
    return false;
  }
  ThreadState* mine = &GetThreadState();
  ThreadState* current = this->GetCurrentThreadState();
  if (current == mine)
  {
    return true;
  }
  if (current)
  {
    this->LoseCurrent();
  }
  return this->MakeCurrent(mine, this->Dispatch, this->Vendor, nullptr);
}

void vtkLamellaOSMesaLibrary::Unbind() const
{
  if (this->GetCurrentThreadState() == &GetThreadState())
  {
    this->LoseCurrent();
  }
  this->OSMesaMakeCurrent(nullptr, nullptr, GlUnsignedByte, 0, 0);
}

bool vtkLamellaOSMesaLibrary::IsBound(void* context) const
{
  return this->OSMesaGetCurrentContext() == context &&
    this->GetCurrentThreadState() == &GetThreadState();
}
