# Run at installation: manual pages made from --help by help2man, and the changelog in Debian's form. Set before:
# programs (names), folder (where they lie), version, work (a folder to write in), here (this folder).
cmake_minimum_required(VERSION 3.25)
set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share")

file(TIMESTAMP "${folder}/palp" date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file("${here}/changelog.in" "${work}/changelog" @ONLY)
file(MAKE_DIRECTORY "${share}/doc/palp")
execute_process(COMMAND gzip -9nc "${work}/changelog" OUTPUT_FILE "${share}/doc/palp/changelog.gz" COMMAND_ERROR_IS_FATAL ANY)

find_program(HELP2MAN help2man)
if(NOT HELP2MAN)
  message(STATUS "No manual pages: help2man is not installed")
  return()
endif()
file(MAKE_DIRECTORY "${share}/man/man1")
set(ENV{PATH} "${folder}:$ENV{PATH}")
set(ENV{XDG_RUNTIME_DIR} "${work}")

# page(NAME COMMAND WHAT [ALSO ...]): the page NAME(1) of a command, e.g. palp-solve of "palp solve".
function(page name command what)
  list(TRANSFORM ARGN REPLACE "(.+)" "\\\\fB\\1\\\\fR(1)")
  list(JOIN ARGN ", " also)
  file(WRITE "${work}/include" "[see also]\n${also}\n")
  execute_process(COMMAND ${HELP2MAN} --no-info --section=1 --name=${what} --version-string=${version}
    --source=palp\ ${version} "--manual=Palp" --include=${work}/include ${command}
    OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(TOUPPER ${name} title)
  string(REGEX REPLACE "\n\\.TH [^ ]+ " "\n.TH ${title} " text "${text}")
  string(REGEX REPLACE "(\\.SH NAME\n)[^\\]+ \\\\- " "\\1${name} \\\\- " text "${text}")
  file(WRITE "${work}/${name}.1" "${text}")
  execute_process(COMMAND gzip -9nc "${work}/${name}.1" OUTPUT_FILE "${share}/man/man1/${name}.1.gz"
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()

execute_process(COMMAND palp --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*Subcommands:\n" "" commands "${help}")
string(REGEX REPLACE "\n\n.*" "\n" commands "${commands}")
string(REPLACE ";" "@" commands "${commands}") # a semicolon parts the elements of CMake's lists
string(REGEX MATCHALL "  [a-z]+ +[^\n]+" commands "${commands}")
set(names)
foreach(line IN LISTS commands)
  string(REGEX MATCH "  ([a-z]+) +([^\n]+)" _ "${line}")
  set(command "${CMAKE_MATCH_1}") # the next REGEX sets it anew
  list(APPEND names palp-${command})
  string(REPLACE "@" "\;" what "${CMAKE_MATCH_2}")
  string(REGEX REPLACE "\\.$" "" what "${what}") # a sentence in --help, a phrase after NAME
  page(palp-${command} "palp ${command}" "${what}" palp)
endforeach()
if(NOT names)
  message(FATAL_ERROR "palp --help names no commands")
endif()
page(palp palp "tactile sensors of conductive rubber, from the block to the force" ${names} palp-studio)
if(palp-studio IN_LIST programs)
  page(palp-studio palp-studio "workbench for soft three-axis tactile sensors" palp)
endif()
