# Says in the pages of help that they are UTF-8, which ParaView 5.11 leaves out: cmake -DFOLDER=F -P help_charset.cmake
file(GLOB pages "${FOLDER}/*.html")
foreach(page IN LISTS pages)
  file(READ "${page}" text)
  if(NOT text MATCHES "charset=")
    string(REPLACE "<head>"
      "<head>\n        <meta http-equiv=\"Content-Type\" content=\"text/html; charset=utf-8\"/>" text "${text}")
    file(WRITE "${page}" "${text}")
  endif()
endforeach()
