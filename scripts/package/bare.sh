# Scripts that try Meniscus in a bare Debian source this. They need root and mmdebstrap. MENISCUS_SUITE names the
# release of Debian, bookworm by default. The folder $work is temporary; $home is /root of the bare system.
((EUID == 0)) || { echo "$(basename "$0"): a bare system is made by root" >&2; exit 2; }
work=$(mktemp -d)
root=$work/root
home=$root/root
clean() {
  for mounted in proc dev; do mountpoint -q "$root/$mounted" && umount "$root/$mounted"; done
  rm -rf --one-file-system "$work"
}
trap clean EXIT

# bare_system FILE-OR-FOLDER: makes a bare system of MENISCUS_SUITE.
bare_system() {
  mmdebstrap --variant=minbase "${MENISCUS_SUITE:-bookworm}" "$1" >"$work/mmdebstrap.log" 2>&1 ||
    { tail -n 5 "$work/mmdebstrap.log" >&2; exit 1; }
}

# take_packages [FOLDER]: sets $packages to a folder of Debian packages; without one they are made from build/test.
take_packages() {
  packages=${1:-$work/packages}
  [[ $1 ]] || bash scripts/package/debian.sh "$packages" build/test 2>/dev/null
}

# enter_bare [BARE.tar]: makes the bare system in which `check` runs commands, or unpacks one that was made before.
enter_bare() {
  mkdir "$root"
  if [[ ${1:-} ]]; then tar xf "$1" -C "$root"; else bare_system "$root"; fi
  mount -t proc proc "$root/proc"
  mount --bind /dev "$root/dev"
  cp /etc/resolv.conf "$root/etc/"
}

# copy_tree: copies the files of this tree to /root/meniscus of the bare system.
copy_tree() {
  mkdir "$home/meniscus"
  git ls-files -z --cached --others --exclude-standard | tar c --null -T - --ignore-failed-read 2>/dev/null | tar x -C "$home/meniscus"
}

# `check` calls this function to run commands; this one runs them in /root of the bare system.
bare_environment=(PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive)
run_checked() { chroot "$root" env -i "${bare_environment[@]}" bash -c "cd && $*"; }
install="apt-get install -y --no-install-recommends"

# check WHAT COMMAND...: counts a case, and prints whether the command succeeded and its last line.
cases=0 failures=0
check() {
  local what=$1
  shift
  cases=$((cases + 1))
  if run_checked "$@" >"$work/log" 2>&1; then
    echo "good    $what: $(tail -n 1 "$work/log" | cut -c 1-160)"
  else
    failures=$((failures + 1))
    echo "FAILED  $what"
    tail -n 15 "$work/log"
  fi
}
