# Sourced by tests/run: stages and their times, counts of what passed, failed and was skipped, and an end that leaves no
# process and no temporary folder behind, however it comes about.

passed=0
failed=0
skipped=0
notes=()
stages=() # SECOND NAME of each that began
begun=()  # process groups that may still run
scratch=$(mktemp -d)

# minutes SECONDS: "3 min 07 s"
minutes() { printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); }

# stage NAME: reports which stage begins, and when.
stage() {
  stages+=("$SECONDS $1")
  echo "== $1 ($(minutes "$SECONDS"))"
}

# begin COMMAND...: runs it in the background, in a process group of its own ($group), which ends with this script.
begin() {
  set -m
  "$@" < /dev/null &
  set +m
  group=$!
  begun+=("$group")
}

# required NAME COMMAND...: a step without which nothing further can be done.
required() {
  begin "${@:2}"
  awaited "$1" "$group"
}

# awaited NAME GROUP [LOG]: the same of what began earlier; where it failed its log is shown.
awaited() {
  wait "$2" && return
  [ -z "${3:-}" ] || cat "$3"
  failed=$((failed + 1))
  notes+=("FAILED: $1")
  exit 1
}

# check NAME COMMAND...: a test of its own; its exit code 77 means that it was skipped.
check() {
  local code=0
  stage "$1"
  begin "${@:2}"
  wait "$group" || code=$?
  case $code in
  0) passed=$((passed + 1)) ;;
  77) skipped=$((skipped + 1)) && notes+=("SKIPPED: $1") ;;
  *) failed=$((failed + 1)) && notes+=("FAILED: $1") ;;
  esac
}

# ctestIn FOLDER LOG CTEST-OPTION...: prints what failed or was skipped, not what passed.
ctestIn() {
  ctest --test-dir "$1" --output-on-failure --timeout 900 --no-tests=error "${@:3}" 2>&1 | tee "$2" |
    grep --line-buffered -vE '^ +Start +[0-9]+: |^ *[0-9]+/[0-9]+ Test +#[0-9]+: .* Passed +[0-9.]+ sec$' || true
}

# runTests FOLDER CTEST-OPTION...: counts what CTest ran, one more at once than there are cores: many wait for a live board.
runTests() {
  begin ctestIn "$1" "$scratch/log" -j $(($(nproc) + 1)) "${@:2}"
  wait "$group" || true
  countTests "$1" "$scratch/log"
}

# countTests FOLDER LOG: adds what CTest printed. Its total is without the disabled, its failures are with what it did not find.
countTests() {
  local line total bad left disabled
  line=$(grep -E '[0-9]+ tests failed out of [0-9]+' "$2" || true)
  if [ -z "$line" ]; then
    failed=$((failed + 1))
    notes+=("FAILED: no test ran in $1")
    return
  fi
  bad=$(sed -E 's/.* ([0-9]+) tests failed out of ([0-9]+).*/\1/' <<< "$line")
  total=$(sed -E 's/.* ([0-9]+) tests failed out of ([0-9]+).*/\2/' <<< "$line")
  left=$(grep -cE '^\s+[0-9]+ - .* \(Skipped\)$' "$2" || true)
  disabled=$(grep -cE '^\s+[0-9]+ - .* \(Disabled\)$' "$2" || true)
  passed=$((passed + total - bad - left))
  failed=$((failed + bad))
  skipped=$((skipped + left + disabled + $(skippedInShards "$1")))
  [ "$bad" -eq 0 ] || notes+=("FAILED: $bad tests in $1")
}

# skippedInShards FOLDER: what GoogleTest skipped within processes of many tests, each of which passed as one of CTest's.
skippedInShards() {
  awk '/^\[  SKIPPED \] [0-9]+ test/ { inThis = $4 }
    /^Test Passed\.$/ { all += inThis }
    /^Command: / { inThis = 0 }
    END { print all + 0 }' "$1/Testing/Temporary/LastTest.log" 2> /dev/null || echo 0
}

# running: is anything left of what was begun, other than processes that nobody has waited for?
running() {
  { cat /proc/[0-9]*/stat 2> /dev/null || true; } | sed 's/.*) //' |
    awk -v begun=" ${begun[*]} " '$1 != "Z" && index(begun, " " $3 " ") { found = 1 } END { exit !found }'
}

# endBegun: ends what still runs of what was begun; what does not end within five seconds is killed.
endBegun() {
  local signal try
  for signal in TERM KILL; do
    running || return 0
    kill -$signal -- "${begun[@]/#/-}" 2> /dev/null || true
    for try in $(seq 50); do
      running || return 0
      sleep 0.1
    done
  done
}

printTimes() {
  local i began next=$SECONDS
  echo "Times by stage:"
  for ((i = ${#stages[@]} - 1; i >= 0; --i)); do
    began=${stages[i]%% *}
    echo "  $(minutes $((next - began)))  ${stages[i]#* }"
    next=$began
  done | tac
  echo "  $(minutes "$SECONDS")  in all"
}

finish() {
  local code=$?
  trap - EXIT
  trap '' INT TERM HUP
  endBegun
  rm -rf "$scratch"
  [ ${#stages[@]} -eq 0 ] || printTimes
  [ "$code" -eq 0 ] || [ "$failed" -gt 0 ] || notes+=("STOPPED: exit code $code")
  [ ${#notes[@]} -eq 0 ] || printf '%s\n' "${notes[@]}"
  echo "$passed passed, $failed failed, $skipped skipped"
  if [ "$failed" -gt 0 ] || [ "$passed" -eq 0 ]; then code=$((code > 0 ? code : 1)); fi
  exit "$code"
}

trap finish EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
