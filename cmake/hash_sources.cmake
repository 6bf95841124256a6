# cmake -DROOT=... -DROOMS=a,b -DOUTPUT=... -P hash_sources.cmake: a header with a hash of the sources of rooms, which is
# the same wherever they lie. Written where it differs only.
string(REPLACE "," ";" rooms "${ROOMS}")
set(text "")
foreach(room ${rooms})
  file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/src/${room}/*.cpp ${ROOT}/src/${room}/*.h
    ${ROOT}/include/grid_path_planner/${room}/*.h)
  list(FILTER sources EXCLUDE REGEX "/(report|findings)/")  # what is told of a run decides nothing of it
  list(SORT sources)
  foreach(source ${sources})
    file(SHA256 ${ROOT}/${source} hash)
    string(APPEND text "${source} ${hash}\n")
  endforeach()
endforeach()
string(SHA256 hash "${text}")
set(header "// Of the sources of ${ROOMS}.\n#pragma once\n\nconstexpr char kSourcesHash[] = \"${hash}\";\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL header)
  file(WRITE ${OUTPUT} "${header}")
endif()
