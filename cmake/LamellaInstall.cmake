# What find_package(Lamella) finds: the solver, and the VTK modules where they are built.
include(CMakePackageConfigHelpers)
set(lamella_package "${CMAKE_INSTALL_LIBDIR}/cmake/lamella")

set(lamella_headers "${PROJECT_BINARY_DIR}/solver_headers")
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" \"-DSOURCE=${PROJECT_SOURCE_DIR}/solver\"
  \"-DHEADERS=${lamella_headers}\" -P \"${CMAKE_CURRENT_LIST_DIR}/SolverHeaders.cmake\" COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT development)
install(DIRECTORY "${lamella_headers}/lamella" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
install(TARGETS lamella_solver EXPORT LamellaSolver
  ARCHIVE COMPONENT development
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT LamellaSolver FILE Lamella-solver.cmake NAMESPACE Lamella:: DESTINATION "${lamella_package}"
  COMPONENT development)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/LamellaConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/LamellaConfig.cmake" INSTALL_DESTINATION "${lamella_package}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/LamellaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/LamellaConfig.cmake" "${PROJECT_BINARY_DIR}/LamellaConfigVersion.cmake"
  DESTINATION "${lamella_package}" COMPONENT development)
