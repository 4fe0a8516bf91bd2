#!/usr/bin/env bash
# Builds libmeniscus alone in a bare Debian 12 with a compiler, CMake, GLM, fmt and TBB, and no other library that
# Meniscus can use; runs a C program and the Python package with it, and checks that every call that needs more reports
# this. Needs root and mmdebstrap.
#
#   scripts/package/try_library.sh [BARE.tar]
#
# BARE.tar is a bare system made before (mmdebstrap --variant=minbase bookworm BARE.tar). The last line says
# `cases N failures M`.
set -euo pipefail
cd "$(dirname "$0")/../.."
source scripts/package/bare.sh
enter_bare "${1:-}"
copy_tree
printf '0 0 0 1.7\n1.5 0 0 1.7\n2.3 1.3 0 1.52\n6 0 0 1.7\n' >"$home/atoms.xyzr"
cat >"$home/read.c" <<'C'
#include <meniscus/meniscus.h>
#include <stdio.h>

int main(void) {
  meniscus_structure* structure = NULL;
  const meniscus_status status = meniscus_read("molecule.pdb", NULL, &structure);
  printf("%d %s\n", status, meniscus_last_error());
  return structure != NULL;
}
C
cat >"$home/compute.py" <<'PYTHON'
import meniscus
import numpy as np

rows = np.loadtxt("atoms.xyzr")
s = meniscus.surface(rows[:, :3], rows[:, 3], device="auto")
print(f"area {s.area:.17g}, volume {s.volume:.17g}", file=open("measures", "w"))
assert abs(s.atom_areas.sum() - s.area) < 1e-9 and s.device.startswith("cpu")
mesh = s.mesh(0.05)
for name in ("a.ply", "a.stl", "a.obj", "a.off", "a.vtp"):
    mesh.save(name)
assert s.render(size="40x30", silhouettes="1pt").pixels.any() and len(s.pockets()) == 0
PYTHON
cat >"$home/missing.py" <<'PYTHON'
import os
import meniscus

s = meniscus.surface([[0, 0, 0]], 1.7)
for call, error, sentence in (
        (lambda: meniscus.read("molecule.pdb"), meniscus.UsageError, "made without gemmi"),
        (lambda: meniscus.Scene("molecule.pdb"), meniscus.UsageError, "made without gemmi, nlohmann_json or FreeType"),
        (lambda: meniscus.Scene().render("cpu"), meniscus.UsageError, "draws no scenes"),
        (lambda: s.mesh(0.1).save("a.glb"), meniscus.UsageError, "made without nlohmann_json"),
        (lambda: s.mesh(0.1).save("a.3mf"), meniscus.UsageError, "made without libdeflate"),
        (lambda: meniscus.surface([[0, 0, 0]], 1.7, device="gpu"), meniscus.GpuError, "made without epoxy"),
        (lambda: s.render(size="20x20", device="software"), meniscus.GpuError, "made without epoxy")):
    try:
        call()
    except error as caught:
        assert sentence in str(caught) and "\n" not in str(caught), caught
        print(caught)
    else:
        raise SystemExit(f"nobody said: {sentence}")
assert not os.path.exists("a.glb") and not os.path.exists("a.3mf")
PYTHON

bare_environment+=(PYTHONPATH=/root/meniscus/exporters/bindings/python)

check "lists of packages" apt-get update
check "a compiler, CMake and three libraries" $install g++ cmake ninja-build libglm-dev libfmt-dev libtbb-dev
check "nothing else is there" '! ls -d /usr/include/gemmi /usr/include/zlib.h /usr/include/epoxy /usr/include/nlohmann \
  /usr/include/libdeflate.h /usr/include/CLI /usr/include/boost /usr/include/hdf5 /usr/include/OpenImageIO 2>/dev/null'
check "configures" 'cmake -S meniscus -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_APP=OFF >configured && tail -n 1 configured'
check "says what is built, and why the rest is not" 'for part in gemmi zlib epoxy nlohmann_json libdeflate; do
  grep "no: $part.* was not found" configured || exit 1; done'
check "builds" "cmake --build build -j ${MENISCUS_JOBS:-$(nproc)}"
check "installs, and says what is left to do" 'cmake --install build --prefix /usr/local | grep "run ldconfig" && ldconfig'
check "needs fmt and TBB" '! readelf -d /usr/local/lib/*/libmeniscus.so.0 | grep NEEDED | grep -vE "lib(fmt|tbb|stdc\+\+|m|gcc_s|c)\.so|ld-linux"'
check "Python with numpy" $install python3-numpy
check "Python computes, meshes and draws" python3 compute.py
check "a C program is compiled" 'cc meniscus/exporters/bindings/c/example/areas.c -lmeniscus -o areas'
check "it says what Python says" './areas <atoms.xyzr | grep -F "$(cat measures)"'
check "Python says what this build cannot" python3 missing.py
check "C says what this build cannot" 'cc read.c -lmeniscus -o read && ./read | grep "^2 molecule.pdb: this build reads no molecule files"'
check "an archive" 'cmake -DBUILD_SHARED_LIBS=OFF build && cmake --build build && cmake --install build --prefix /opt/archive &&
  ls /opt/archive/lib/*/libmeniscus.a && ! ls /opt/archive/lib/*/*.so*'
check "a C program that needs no libmeniscus" 'cmake -G Ninja -S meniscus/exporters/bindings/c/example -B of_archive -DCMAKE_PREFIX_PATH=/opt/archive &&
  cmake --build of_archive && ! readelf -d of_archive/areas | grep libmeniscus && of_archive/areas <atoms.xyzr | grep -F "$(cat measures)"'
echo "cases $cases failures $failures"
((failures == 0))
