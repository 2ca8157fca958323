# Sourced by app/run and tests/run: what both need to install and build. The repository's root is the current folder.

# packageNames [SECTION ...]: names in app/packages.txt above its first section, and those of the sections.
packageNames() {
  awk -v wanted=" $* " '
    /^#/ || !NF { next }
    /^\[/ { section = substr($0, 2, length($0) - 2); next }
    section == "" || index(wanted, " " section " ") { print }' app/packages.txt
}

# Installs the Debian packages that are missing, as root or with sudo.
installMissing() {
  local name missing=()
  for name in $(packageNames "$@"); do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "Installing: ${missing[*]}" >&2
  local asRoot=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "These packages are missing and neither root nor sudo is there to install them." >&2; exit 1; }
    asRoot=(sudo)
  fi
  "${asRoot[@]}" apt-get update -q >&2
  "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}" >&2
}

# buildJobs: how many compilers run at once: one per core, but no more than fit into the free memory, at 1.5 GB each.
buildJobs() {
  local cores fit
  cores=$(nproc)
  fit=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null)
  [ "${fit:-$cores}" -ge 1 ] || fit=1
  [ "${fit:-$cores}" -lt "$cores" ] && echo "$fit" || echo "$cores"
}

# configureAndBuild FOLDER [CMAKE OPTION ...]: all, or the target named in $buildTarget. A new folder is a Release build by
# Ninja that compiles several files as one; generator, build type and that choice of an existing one stay as they are.
configureAndBuild() {
  local folder=$1
  shift
  [ -f "$folder/CMakeCache.txt" ] || set -- -G Ninja -DCMAKE_BUILD_TYPE=Release -DPALP_FEWER_FILES=ON "$@"
  cmake -S . -B "$folder" "$@" >&2
  cmake --build "$folder" --parallel "$(buildJobs)" --target "${buildTarget:-all}" >&2
}
