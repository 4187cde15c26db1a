# Flags that every target of ours is compiled with: link to lamella_compiler (PRIVATE).
add_library(lamella_compiler INTERFACE)
target_compile_options(lamella_compiler INTERFACE -Wall -Wextra -Wpedantic -Wno-psabi)
if(LAMELLA_NATIVE)
  target_compile_options(lamella_compiler INTERFACE -march=native)
endif()
if(LAMELLA_SANITIZE)
  target_compile_options(lamella_compiler INTERFACE
    -fsanitize=${LAMELLA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lamella_compiler INTERFACE -fsanitize=${LAMELLA_SANITIZE})
endif()
