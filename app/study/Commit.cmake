# Run at each build: the commit of the sources in `source` into the file `output`, which is touched only where it changed.
set(commit "")
execute_process(COMMAND git -C ${source} describe --always --exclude=* --abbrev=10 --dirty=+
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(commit STREQUAL "")
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${output} CONTENT "namespace palp {
extern const char* const kCommit;
const char* const kCommit = \"${commit}\";
} // namespace palp
")
