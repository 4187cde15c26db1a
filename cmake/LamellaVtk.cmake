# Finds VTK and builds the VTK modules under vtkfilters/.
#
# Components are named one by one: without, every VTK module's third-party packages would be searched for.
set(lamella_vtk_components
  CommonCore CommonDataModel CommonExecutionModel FiltersCore IOXML
  RenderingCore RenderingOpenGL2)
if(LAMELLA_PYTHON)
  list(APPEND lamella_vtk_components Python WrappingPythonCore)
  set(Python3_FIND_STRATEGY LOCATION) # the system's, which VTK is built for, before others in PATH
  if(NOT Python3_ROOT_DIR)
    set(Python3_ROOT_DIR /usr)
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development)
endif()
# vtkfilters/offscreen loads OpenGL through VTK's GLEW; VTK >= 9.4 has none and needs none of ours.
set(lamella_vtk_find REQUIRED COMPONENTS ${lamella_vtk_components} OPTIONAL_COMPONENTS glew)

if(LAMELLA_PARAVIEW)
  set(lamella_paraview_components RemotingCore RemotingServerManager)
  if(LAMELLA_PLUGIN)
    list(APPEND lamella_paraview_components RemotingViews pqCore pqComponents pqApplicationComponents)
  endif()
  set(CMAKE_WARN_DEPRECATED OFF) # ParaView's own package files use a name that its VTK has changed
  find_package(ParaView 5.11 REQUIRED COMPONENTS ${lamella_paraview_components})
  unset(CMAKE_WARN_DEPRECATED)
  find_package(VTK ${lamella_vtk_find} PATHS "${ParaView_DIR}/vtk" NO_DEFAULT_PATH)
else()
  find_package(VTK 9.1 ${lamella_vtk_find})
endif()
message(STATUS "VTK ${VTK_VERSION} in ${VTK_DIR}")

# Debian's ParaView exports targets that name third-party targets nothing has looked for. They are linked
# already, inside its shared libraries, so empty ones do.
foreach(target LibXml2::LibXml2 hdf5::hdf5 hdf5::hdf5_hl Boost::boost NetCDF::NetCDF TIFF::TIFF PNG::PNG
    JPEG::JPEG Freetype::Freetype LZMA::LZMA LZ4::LZ4 utf8cpp::utf8cpp)
  if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED GLOBAL)
  endif()
endforeach()

# What is installed finds our libraries wherever the whole installation is put.
if(NOT CMAKE_INSTALL_RPATH)
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endif()

add_subdirectory(vtkfilters/fields)
set(lamella_module_files
  "${PROJECT_SOURCE_DIR}/vtkfilters/vtk.module"
  "${PROJECT_SOURCE_DIR}/vtkfilters/offscreen/vtk.module")
vtk_module_scan(
  MODULE_FILES ${lamella_module_files}
  REQUEST_MODULES Lamella::vtkLamellaFilters Lamella::vtkLamellaOffscreen
  PROVIDES_MODULES lamella_modules
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${lamella_modules}
  PACKAGE Lamella
  INSTALL_EXPORT Lamella
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lamella/vtk"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/lamella"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  ARCHIVE_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME_DESTINATION "${CMAKE_INSTALL_BINDIR}"
  LIBRARY_NAME_SUFFIX ""
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}")

if(LAMELLA_PYTHON)
  set(lamella_python_modules "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
  list(APPEND CMAKE_INSTALL_RPATH "$ORIGIN/../../..") # from the package to our libraries
  vtk_module_wrap_python(
    MODULES Lamella::vtkLamellaFilters
    TARGET Lamella::python
    PYTHON_PACKAGE lamella
    MODULE_DESTINATION "${lamella_python_modules}"
    INSTALL_HEADERS OFF)
  add_subdirectory(python)
endif()
