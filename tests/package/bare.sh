# Sourced by bare-debian and bare-build: a Debian that has nothing else, in a folder of this machine. As root.

fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# inNamespaces ARG ...: the calling script once more, where its mounts and processes are its own and end with it.
inNamespaces() {
  [ $$ -ne 1 ] || return 0 # the first process of its namespace
  [ "$(id -u)" -eq 0 ] || fail "needs root, for chroot and mounts"
  exec unshare --mount --pid --fork --kill-child --mount-proc "$0" "$@"
}

# makeBare SUITE FOLDER LOG: Debian's essential packages, from the server that apt is set up with.
makeBare() {
  local suite=$1 root=$2 log=$3 server
  server=$(apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's/^Debian Debian //p' | sort -u | head -1)
  [ -n "$server" ] || fail "apt is set up with no server of Debian's (/etc/apt/sources.list.d); none is known besides"
  debootstrap --variant=minbase "$suite" "$root" "$server" > "$log" 2>&1 || fail "debootstrap: $(tail -5 "$log")"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount --rbind /sys "$root/sys"
}

# inside COMMAND ...: in the folder $root, with the environment of a fresh login.
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LANG=C.UTF-8 "$@"
}
