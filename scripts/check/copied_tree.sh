# Copies the working tree into a temporary folder and goes there. Scripts that change the copy source this; they check
# the program that they build, and end with `finish`.
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$work" 2>/dev/null || true
cd "$work"
cases=0 failures=0

# build TARGET...: builds the copy; `program` is its meniscus.
build() {
  cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DMENISCUS_UNITY=ON >/dev/null
  cmake --build build --target "$@" >/dev/null
  program=$work/build/meniscus
}
# expect WHAT COMMAND...: counts a failure unless the command succeeds.
expect() {
  local what=$1
  shift
  cases=$((cases + 1))
  if "$@" >"$work/said" 2>&1; then return; fi
  failures=$((failures + 1))
  echo "failed: $what: $(tail -n 1 "$work/said")"
}
# says WORDS COMMAND...: counts a failure unless the command, which may fail, prints the words.
says() {
  local said
  said=$("${@:2}" 2>&1 || true)
  grep -q -e "$1" <<<"$said"
}
finish() {
  echo "cases $cases failures $failures"
  ((failures == 0))
}
