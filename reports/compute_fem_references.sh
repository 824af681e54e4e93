#!/bin/sh
# Remakes the finite-element rows that this project computed itself: tests/reference/fem_24_sprags.csv (one to two
# hours of CalculiX on one core) and fem_multi_arc.csv (five minutes). Needs ccx (apt-get install calculix-ccx).
#
#   sh reports/compute_fem_references.sh [multi_arc|24_sprags]     default: both
#
# WORK=DIR keeps decks and results and goes on from those that are there.
set -eu
cd "$(dirname "$0")/.."
command -v ccx >/dev/null 2>&1 || { echo "ccx is not installed. Debian, Ubuntu: apt-get install calculix-ccx" >&2; exit 3; }
tool=${SPRAG_DESIGN:-target/release/sprag-design}
[ -x "$tool" ] || cargo build --release
WORK=${WORK:-$(mktemp -d "${TMPDIR:-/tmp}/sprag-ccx.XXXXXX")}
mkdir -p "$WORK"
export OMP_NUM_THREADS="${OMP_NUM_THREADS:-1}"

# Rows of one table: design|variant|torque reached|spacing in mm|torques read|words of the model column.
compute() {
    table=$1
    rows="$WORK/$table.rows"
    echo "model,torque_nm,normal_n,windup_deg,p0_inner_mpa,tan_ratio" >"$rows"
    while IFS='|' read -r design variant torque mesh torques words; do
        job="$WORK/$table-$variant"
        "$tool" export "designs/$design.toml" --format calculix --variant "$variant" --torque "$torque" --mesh "$mesh" \
            --quiet -o "$job.new"
        if [ -f "$job.dat" ] && cmp -s "$job.new" "$job.inp"; then
            rm "$job.new"
        else
            mv "$job.new" "$job.inp"
            ccx -i "$job" >"$job.log" 2>&1 || { tail -n 20 "$job.log" >&2; exit 3; }
        fi
        "$tool" export "designs/$design.toml" --format calculix --read "$job.dat" --torques "$torques" --quiet \
            --csv "$job.csv" >/dev/null
        awk -F, -v words="$words" '
            FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
            { printf "\"%s\",%g,%.1f,%.4f,%.0f,%.5f\n", words, $at["torque_nm"], $at["normal_inner_n"], $at["windup_deg"], $at["hertz_inner_mpa"], $at["tan_omega"] }' \
            "$job.csv" >>"$rows"
    done
    cp "$rows" "tests/reference/fem_$table.csv"
}

case ${1:-all} in multi_arc | all) compute multi_arc <<'CASES'
huang2017-multi-arc|layer|50|0.025|3.34,10,16.8,26.8,50|2-D, 6 mm layer, h=0.025
CASES
esac
case ${1:-all} in 24_sprags | all) compute 24_sprags <<'CASES'
fe-check-24|layer|600|0.025|60,150,300,450,600|2-D, 13 mm layer, races 13 mm wide as the sprags, h=0.025
fe-check-24|plane-stress|600|0.025|60,150,300,450,600|2-D, true plane stress, races 13 mm wide as the sprags, h=0.025
fe-check-24|plane-strain|600|0.025|60,150,300,450,600|2-D, plane strain, races 13 mm wide as the sprags, h=0.025
CASES
esac
