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

# configureAndBuild FOLDER [CMAKE OPTION ...]: Release with Ninja; all, or the target named in $buildTarget. A folder that is
# made here compiles several files as one; one that was configured by hand stays as it is.
configureAndBuild() {
  local folder=$1
  shift
  [ -f "$folder/CMakeCache.txt" ] || set -- -DPALP_FEWER_FILES=ON "$@"
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" >&2
  cmake --build "$folder" --target "${buildTarget:-all}" >&2
}
