# cpack makes a Debian package: program, plugin, Python package, modules. ParaView reads beside its own
# executable which plugins there are, in a file that Debian's package does not have.
file(CONFIGURE OUTPUT paraview.conf CONTENT
  "../lib/${CMAKE_LIBRARY_ARCHITECTURE}/paraview-5.11/plugins/paraview.plugins.xml
../${CMAKE_INSTALL_LIBDIR}/paraview-5.11/plugins/lamella.plugins.xml
")
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/paraview.conf" DESTINATION bin COMPONENT beside_paraview EXCLUDE_FROM_ALL)
install(FILES LICENSE DESTINATION share/doc/lamella RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lamella)
set(CPACK_PACKAGE_CONTACT "Lamella <lamella@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "paraview, python3-paraview, python3-numpy, libosmesa6, fonts-dejavu-core, fonts-dejavu-extra")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
include(CPack)
