# Builds the ParaView plugin under pvplugin/, and the VTK module of its own sources.
vtk_module_scan(
  MODULE_FILES "${PROJECT_SOURCE_DIR}/pvplugin/vesicle/vtk.module"
  REQUEST_MODULES Lamella::vtkLamellaVesicle
  PROVIDES_MODULES lamella_plugin_modules
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${lamella_plugin_modules}
  PACKAGE LamellaPlugin
  INSTALL_HEADERS OFF
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  ARCHIVE_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME_DESTINATION "${CMAKE_INSTALL_BINDIR}"
  LIBRARY_NAME_SUFFIX ""
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}")

paraview_plugin_scan(
  PLUGIN_FILES "${PROJECT_SOURCE_DIR}/pvplugin/paraview.plugin"
  PROVIDES_PLUGINS lamella_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
list(APPEND CMAKE_INSTALL_RPATH "$ORIGIN/../../..") # from the plugin to our libraries
paraview_plugin_build(
  PLUGINS ${lamella_plugins}
  PLUGINS_FILE_NAME "lamella.plugins.xml"
  RUNTIME_DESTINATION "${CMAKE_INSTALL_BINDIR}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY_SUBDIRECTORY "paraview-5.11/plugins")
