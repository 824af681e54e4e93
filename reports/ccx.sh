# To be sourced by the reports that solve with CalculiX: `tool` and `work`, the folder of decks and results, that of WORK where it
# is given. Ends with 3 without ccx.
if ! command -v ccx >/dev/null 2>&1; then
    echo "ccx is not installed. Debian, Ubuntu: apt-get install calculix-ccx" >&2
    exit 3
fi
tool=${SPRAG_DESIGN:-target/release/sprag-design}
[ -x "$tool" ] || cargo build --release
if [ -n "${WORK:-}" ]; then
    mkdir -p "$WORK"
    work=$(cd "$WORK" && pwd)
else
    work=$(mktemp -d "${TMPDIR:-/tmp}/sprag-ccx.XXXXXX")
    trap 'rm -rf "$work"' EXIT
fi
export OMP_NUM_THREADS="${OMP_NUM_THREADS:-1}"
