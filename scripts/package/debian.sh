#!/usr/bin/env bash
# Makes the Debian packages with debhelper, and their source package.
#
#   scripts/package/debian.sh OUT [BUILD]
#
# OUT is a folder. Everything is built anew from the files of this tree; with the folder BUILD, in which everything is built
# already, it is only packed, without a source package. With MENISCUS_SITE=yes the manual is a site.
set -euo pipefail
cd "$(dirname "$0")/../.."
[[ ${1:-} ]] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2; }
mkdir -p "$1"
out=$(realpath "$1")
built=${2:+$(realpath "$2")}
version=$(sed -n 's/^project(meniscus VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
umask 022

# Git knows which files belong to the tree; a copy of it in a container has no other files.
tree=$work/meniscus-$version
mkdir "$tree"
{ git ls-files -z --cached --others --exclude-standard 2>/dev/null || find . -path ./build -prune -o -type f -print0; } |
  tar c --null -T - --ignore-failed-read 2>/dev/null | tar x -C "$tree"
export SOURCE_DATE_EPOCH
SOURCE_DATE_EPOCH=$(dpkg-parsechangelog -l scripts/package/debian/changelog -S Timestamp)
[[ $built ]] || tar c -C "$work" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner "meniscus-$version" |
  gzip -n -9 >"$work/meniscus_$version.orig.tar.gz"
cp -r scripts/package/debian "$tree/debian"

cd "$tree"
if [[ $built ]]; then
  MENISCUS_BUILD=$built DEB_BUILD_OPTIONS=noautodbgsym dpkg-buildpackage -b -us -uc -nc -d >&2
else
  dpkg-buildpackage -us -uc >&2
fi
mv "$work"/*_* "$out"
