#!/usr/bin/env bash
# Adds an option to a copy of the tree, in three files, and uses it in the command line and its help, shell completion,
# scene files and their schema, the preview, bundles, and the library. Ends with `cases N failures M`.
set -euo pipefail
source "$(dirname "$0")/copied_tree.sh"

# A row of the table, a member of the look, and the line that binds them.
row='number("look.sparkle", "--sparkle", "F", "Strength of a light that only this test knows").from(0, 5)'
row+='.initially("0").in(kLight, kLook),'
sed -i "0,/number(\"look.light_strength\"/s//$row\n&/" core/properties/look_properties.cpp
sed -i 's/^  bool linear_alpha = false;/  std::optional<float> sparkle{};\n&/' core/render/look.h
binding='plain("look.sparkle", [](auto\& s) { return \&s.look.sparkle; }),'
sed -i "0,/coded<direction_of, direction_text>(\"look.light\"/s//$binding\n&/" core/scene/picture_values.cpp

build meniscus meniscus_c

printf '1 0 0 1.7\n3 0 0 1.7\n' >two.xyzr
small=(--size 64x48 --samples 1 -q)
expect "its file count" test "$(grep -rlw sparkle core app exporters gpu_shaders | wc -l)" = 3
expect "the command line" "$program" render two.xyzr -o a.png "${small[@]}" --sparkle 2 --save-scene a.json
expect "a value out of range" says "--sparkle: '9' is not a number from 0 to 5" "$program" render two.xyzr -o b.png --sparkle 9
expect "the help" says "--sparkle F .*this test knows" "$program" render --help-all
expect "completion" says "sparkle" "$program" completion bash
expect "manual pages" "$program" help --man man
expect "a manual page of it" says "sparkle" cat man/meniscus-render.1
expect "the scene that is saved" says '"sparkle": 2' cat a.json
expect "a scene that is read" "$program" render --scene a.json -o c.png "${small[@]}"
expect "a scene out of range" says "look.sparkle: '7'" bash -c "sed 's/\"sparkle\": 2/\"sparkle\": 7/' a.json >d.json; '$program' render --scene d.json -o d.png"
expect "a key of --set" "$program" render two.xyzr -o e.png "${small[@]}" --set look.sparkle=1
expect "the keys of scenes" says "sparkle .*--sparkle" "$program" help scenes
expect "the schema" says '"sparkle"' "$program" help --scene-schema
printf 'MODEL 1\nATOM      1  C   ALA A   1       0.000   0.000   0.000\nENDMDL\nMODEL 2\nATOM      1  C   ALA A   1       1.000   0.000   0.000\nENDMDL\n' >run.pdb
expect "a bundle" "$program" farm bundle bundle --chunk-frames 1 --engine make -- render run.pdb --frames all "${small[@]}" --sparkle 3
expect "its command" says 'sparkle' cat bundle/bundle.json
expect "a worker" "$program" work bundle
printf '{"command":"render_command"}\n{"command":"quit"}\n' >commands.jsonl
expect "the preview" says '"--sparkle"' "$program" preview two.xyzr --sparkle 4 --device cpu --serve --commands commands.jsonl
expect "the library" says 'sparkle: .9. is not a number from 0 to 5' env MENISCUS_LIBRARY=build/exporters/bindings/c/libmeniscus.so \
  PYTHONPATH=exporters/bindings/python /usr/bin/python3 -c 'import meniscus; print(meniscus.Scene(sparkle=3).sparkle); meniscus.Scene(sparkle=9)'
finish
