/**
 * @class vtkLamellaOSMesaLibrary
 * @brief OSMesa, reached through libglvnd's dispatcher
 *
 * All OpenGL calls of a libglvnd system (libGL, libOpenGL, GLEW) go through libGLdispatch, which sends
 * them to the vendor that is current in the calling thread. This class loads libOSMesa and presents
 * it to libGLdispatch (ABI version 1) as such a vendor. Both libraries are opened privately, so that
 * libOSMesa's own gl* symbols hide nobody else's.
 */
#ifndef vtkLamellaOSMesaLibrary_h
#define vtkLamellaOSMesaLibrary_h

#include <string>

class vtkLamellaOSMesaLibrary
{
public:
  /** The libraries, loaded at the first call and never unloaded. */
  static const vtkLamellaOSMesaLibrary& Get();

  /** An OpenGL 3.2 core context; null, and the reason in `why`, if there can be none. */
  void* CreateContext(std::string& why) const;
  void DestroyContext(void* context) const;

  /** Make a context current in this thread, with a buffer of side x side RGBA pixels. */
  bool Bind(void* context, unsigned char* buffer, int side) const;
  void Unbind() const;
  bool IsBound(void* context) const;

private:
  vtkLamellaOSMesaLibrary();
  bool Load();

  /** libGLdispatch's record of a thread (__GLdispatchThreadState in libglvnd's GLdispatch.h). */
  struct ThreadState
  {
    int Tag; // 0: GLX, 1: EGL
    void (*Destroyed)(ThreadState*);
    void* Private;
  };
  static ThreadState& GetThreadState();

  std::string Why; // empty: loaded
  void* Dispatch = nullptr;
  int Vendor = 0;

  // libOSMesa
  void* (*OSMesaCreateContextAttribs)(const int*, void*) = nullptr;
  void (*OSMesaDestroyContext)(void*) = nullptr;
  unsigned char (*OSMesaMakeCurrent)(void*, void*, unsigned int, int, int) = nullptr;
  void* (*OSMesaGetCurrentContext)() = nullptr;
  void (*(*OSMesaGetProcAddress)(const char*))() = nullptr;

  // libGLdispatch
  int (*GetABIVersion)() = nullptr;
  void (*Init)() = nullptr;
  int (*NewVendorID)() = nullptr;
  void* (*CreateTable)(void* (*)(const char*, void*), void*) = nullptr;
  unsigned char (*MakeCurrent)(ThreadState*, void*, int, const void*) = nullptr;
  void (*LoseCurrent)() = nullptr;
  ThreadState* (*GetCurrentThreadState)() = nullptr;
};

#endif
