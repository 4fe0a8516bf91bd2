#!/usr/bin/env bash
# Makes the files of a release from a clean tree, and lists them with their checksums.
#
#   scripts/release.sh [OUT]        OUT is a new folder; build/dist/VERSION by default
#
# It makes the source archive, the Debian packages and their source package, and, for each target that
# scripts/package/targets.sh has built from this commit, a wheel and a Blender extension. SHA256SUMS has a line for
# each. It refuses a tree with changes, versions that disagree, and a changelog without this version.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

version=$(sed -n 's/^project(meniscus VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
out=${1:-build/dist/$version}
refuse() { echo "release.sh: $1" >&2; exit 1; }
[[ -z $(git status --porcelain) ]] || refuse "the tree has changes; commit them, or put them away with git stash"
/usr/bin/python3 -B tests/docs/version_test.py 2>/dev/null || refuse "the version is not $version everywhere: python3 tests/docs/version_test.py"
[[ ! -e $out ]] || refuse "$out exists; give another folder, or remove it"

install_packages "${build_packages[@]}" "${run_packages[@]}" "${deb_packages[@]}"
made=build/release_files
rm -rf "$made"
mkdir -p "$made" "$(dirname "$out")"

echo "source" >&2
git archive --format=tar --prefix="meniscus-$version/" HEAD | gzip -n -9 >"$made/meniscus-$version.tar.gz"

echo "Debian packages" >&2
MENISCUS_SITE=yes bash scripts/package/debian.sh "$made"

# wheels.py takes what is in build/targets, which may be from another commit.
commit=$(git rev-parse HEAD)
built=()
for names in x86_64-linux:linux-x64 aarch64-linux:linux-arm64 x86_64-windows:windows-x64 aarch64-macos:macos-arm64 x86_64-macos:macos-x64; do
  target=${names%:*}  # Blender has another name for the same system
  if [[ $(cat "build/targets/$target/commit" 2>/dev/null) == "$commit" ]]; then
    built+=("$names")
  else
    echo "left out: $target, which scripts/package/targets.sh has not built from this commit" >&2
  fi
done
if ((${#built[@]})); then
  echo "wheels and extensions: ${built[*]%:*}" >&2
  /usr/bin/python3 scripts/package/wheels.py "$made" "${built[@]%:*}" >&2
  bash scripts/extension.sh "$made" "$made" "${built[@]#*:}" >&2
fi

(cd "$made" && sha256sum -- * >SHA256SUMS)
mv "$made" "$out"
echo "$out:"
(cd "$out" && cat SHA256SUMS)
