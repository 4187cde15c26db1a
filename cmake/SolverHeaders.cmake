# Script: puts the headers in SOURCE below HEADERS/lamella, for others to include as
# <lamella/energy/surface_term.h>. In our sources they name each other without the first part; with it nothing of
# ours is in the way of what others have, such as error.h.
file(REMOVE_RECURSE "${HEADERS}")
file(GLOB_RECURSE headers RELATIVE "${SOURCE}" "${SOURCE}/*.h")
foreach(header IN LISTS headers)
  file(READ "${SOURCE}/${header}" text)
  if(text MATCHES "#include [<\"](ginac|hdf5|toml\\+\\+|store/hdf5|store/h5_image)")
    continue() # of libraries that are ours alone
  endif()
  string(REGEX REPLACE "#include \"" "#include \"lamella/" text "${text}")
  file(WRITE "${HEADERS}/lamella/${header}" "${text}")
endforeach()
