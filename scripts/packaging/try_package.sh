#!/usr/bin/env bash
# Installs a Debian package into a bare Debian 12 and runs the program there: version, a surface, a picture by software
# GL, manual and completion; then takes it away again. As root, with mmdebstrap.
#
#   scripts/packaging/try_package.sh [PACKAGE.deb [BARE.tar]]
#
# Without a package that of build/test is made; BARE.tar is a bare system made before (mmdebstrap --variant=minbase
# bookworm BARE.tar). The last line says `cases N failures M`.
set -euo pipefail
cd "$(dirname "$0")/../.."
package=${1:-}
bare=${2:-}
((EUID == 0)) || { echo "try_package.sh: a bare system is made by root" >&2; exit 2; }

work=$(mktemp -d)
root=$work/root
clean() {
  for mounted in proc dev; do mountpoint -q "$root/$mounted" && umount "$root/$mounted"; done
  rm -rf --one-file-system "$work"
}
trap clean EXIT

if [[ ! $package ]]; then
  cpack --config build/test/CPackConfig.cmake -B "$work/packages" >/dev/null
  package=$(echo "$work"/packages/meniscus_*.deb)
fi
mkdir "$root"
if [[ $bare ]]; then
  tar xf "$bare" -C "$root"
else
  mmdebstrap --variant=minbase bookworm "$root" >"$work/mmdebstrap.log" 2>&1 || { tail -n 5 "$work/mmdebstrap.log" >&2; exit 1; }
fi
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
cp /etc/resolv.conf "$root/etc/"
cp "$package" "$root/root/meniscus.deb"
molecule=$(dpkg -L pymol-data | awk '/\/1tii\.pdb$/ && !n++')
cp "$molecule" "$root/root/1tii.pdb"

cases=0 failures=0
# check WHAT COMMAND...: in the bare system, as it was installed there.
check() {
  local what=$1
  shift
  cases=$((cases + 1))
  if chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@" \
    >"$work/log" 2>&1; then
    echo "good    $what: $(tail -n 1 "$work/log" | cut -c 1-100)"
  else
    failures=$((failures + 1))
    echo "FAILED  $what"
    tail -n 5 "$work/log"
  fi
}

check "lists of packages" apt-get update
check "installs with what it depends on" apt-get install -y --no-install-recommends /root/meniscus.deb
check "version" meniscus --version
check "surface on the CPU" meniscus surface /root/1tii.pdb --device cpu
check "help of a command" meniscus render --help
check "manual" test -s /usr/share/man/man1/meniscus-render.1.gz
check "completion" bash -c 'source /usr/share/bash-completion/completions/meniscus && complete -p meniscus'
check "installs software GL" apt-get install -y --no-install-recommends libegl-mesa0 libgl1-mesa-dri
check "picture by software GL" meniscus render /root/1tii.pdb -o /root/1tii.png --size 320x240 --device software
check "the picture is one" bash -c 'head -c 4 /root/1tii.png | tail -c 3 | grep -q PNG'
check "versions" meniscus --version --verbose
check "files are as they were packed" dpkg -V meniscus
check "goes away again" apt-get purge -y meniscus
check "leaves nothing behind" bash -c '! ls /usr/bin/meniscus /usr/lib/meniscus /usr/share/meniscus 2>/dev/null'
echo "cases $cases failures $failures"
((failures == 0))
