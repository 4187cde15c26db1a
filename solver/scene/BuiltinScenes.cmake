# Compiles data/scenes/*.toml into the solver, so that the program needs no data folder.
# Sets LAMELLA_BUILTIN_SCENES to the generated source. A scene's title stands on a line of its own.
set(scene_dir "${PROJECT_SOURCE_DIR}/data/scenes")
file(GLOB scene_files CONFIGURE_DEPENDS "${scene_dir}/*.toml")
list(SORT scene_files)
set(BUILTIN_SCENES "")
foreach(scene_file IN LISTS scene_files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${scene_file}")
  cmake_path(GET scene_file STEM LAST_ONLY scene_name)
  file(READ "${scene_file}" scene_text)
  if(NOT scene_text MATCHES "(^|\n)title = \"([^\"\n]+)\"\n")
    message(FATAL_ERROR "${scene_file}: a built-in scene needs a line title = \"...\"")
  endif()
  string(APPEND BUILTIN_SCENES
    "    {\"${scene_name}\", R\"toml(${CMAKE_MATCH_2})toml\", R\"toml(${scene_text})toml\"},\n")
endforeach()
set(LAMELLA_BUILTIN_SCENES "${CMAKE_CURRENT_BINARY_DIR}/builtin_scenes.cpp")
configure_file("${CMAKE_CURRENT_LIST_DIR}/builtin_scenes.cpp.in" "${LAMELLA_BUILTIN_SCENES}" @ONLY)
