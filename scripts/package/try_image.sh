#!/usr/bin/env bash
# Builds the image of a farm node (Dockerfile) on a bare Debian 12, and makes the frames of a film in it as a node does:
# the bundle is mounted, no user is logged in, and software GL draws. As root, with buildah and mmdebstrap; without a registry
# of images and without a daemon, and (storage by copies, isolation by chroot) inside of other containers, too.
#
#   scripts/package/try_image.sh [FOLDER [BARE.tar]]
#
# As for try_package.sh: FOLDER has the packages, or is a clone (.), which the image's first stage then builds; BARE.tar is a
# bare system. The last line says `cases N failures M`.
set -euo pipefail
cd "$(dirname "$0")/../.."
bare=${2:-}
source scripts/package/bare.sh
export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
buildah() { command buildah --root "$work/storage" --runroot "$work/run" "$@"; }
take_packages "${1:-}"
if [[ ! $bare ]]; then
  bare=$work/bare.tar
  bare_system "$bare"
fi

run_checked() { "$@"; }
base() {
  local container
  container=$(buildah from scratch) && buildah add -q "$container" "$bare" / && buildah commit -q --rm "$container" bare
}
# in_node COMMAND...: runs a command in a container of the image, with the bundle's folder mounted.
in_node() { buildah run -v "$work/films:/bundle" "$node" -- "$@"; }
entry_point() {
  local told='{{.OCIv1.Config.Entrypoint}} {{.OCIv1.Config.User}}'
  [[ $(buildah inspect --type image --format "$told" node) == "[meniscus] nobody" ]]
}
pictures() { [[ $(head -q -c 4 "$work"/films/film/images/frame_*.png | tr -d '\211') == PNGPNGPNG ]]; }

check "a base of nothing but Debian" base
check "the image" buildah build -q --build-arg BASE=localhost/bare -f scripts/package/Dockerfile \
  --ignorefile scripts/package/Dockerfile.dockerignore -t node "$packages"
check "its size" buildah images --format '{{.Size}}' node
check "it runs the program, as nobody" entry_point
node=$(buildah from node)
mkdir -m 777 "$work/films"
for frame in 1 2 3; do
  printf 'MODEL     %4d\nHETATM    1  C   LIG A   1      %6.3f   0.000   0.000  1.00  0.00           C\n' $frame $frame
  printf 'HETATM    2  O   LIG A   1       0.000   0.000   0.000  1.00  0.00           O\nENDMDL\n'
done >"$work/films/moving.pdb"
check "version" in_node meniscus --version --verbose
check "a bundle" in_node meniscus farm bundle film --chunk-frames 1 -- \
  render moving.pdb --frames all --size 160x120 --device software
check "the work" in_node meniscus work film
check "all is there" in_node meniscus farm verify film
check "three pictures" pictures
echo "cases $cases failures $failures"
((failures == 0))
