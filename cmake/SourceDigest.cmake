# Script: writes to HEADER the eight first digits of what the C++ sources in FOLDER hash to.
file(GLOB_RECURSE sources RELATIVE "${FOLDER}" "${FOLDER}/*.h" "${FOLDER}/*.cpp")
foreach(source IN LISTS sources) # in the order of their names
  file(SHA256 "${FOLDER}/${source}" digest)
  string(APPEND all "${source} ${digest}\n")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING "${digest}" 0 8 digest)
file(WRITE "${HEADER}" "#define LAMELLA_SOURCE_DIGEST \"${digest}\"\n")
