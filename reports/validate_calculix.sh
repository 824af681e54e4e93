#!/bin/sh
# Finite elements end to end: export the single-arc clutch of Table 1, solve it with CalculiX, read the result and
# hold it against tests/reference/fem_single_arc.csv (an independent CalculiX model) and against the design's law.
#
#   sh reports/validate_calculix.sh            layer, plane stress and plane strain to 26.8 Nm, some ten minutes
#   sh reports/validate_calculix.sh --long     also the layer to 100 Nm, some ten minutes more
#
# WORK=DIR keeps decks and results there, and takes a result that is there already if its deck is the same.
# Writes reports/calculix-single-arc.csv and .md. Exit code 1 where a windup is more than 1 % off, 3 without ccx.
set -eu
cd "$(dirname "$0")/.."
. reports/ccx.sh
design=designs/huang2017-single-arc.toml
reference=tests/reference/fem_single_arc.csv

# Name, variant, torque reached, spacing in mm, torques read, words that name its rows in the reference.
cases="layer|layer|26.8|0.025|3.34,10,16.8,26.8|2-D, 6 mm layer
plane-stress|plane-stress|26.8|0.025|3.34,10,16.8,26.8|2-D, true plane stress
plane-strain|plane-strain|26.8|0.025|3.34,10,16.8,26.8|2-D, plane strain"
if [ "${1:-}" = --long ]; then
    cases="$cases
long|layer|100|0.03|50,100|same, h=0.025, long path"
fi

out=reports/calculix-single-arc.csv
version=$(ccx -v | tr -dc '0-9.')
echo "variant,mesh_mm,torque_nm,normal_n,reference_normal_n,windup_deg,reference_windup_deg,windup_off_percent,tan_omega,reference_tan,p0_inner_mpa,reference_p0_mpa,law_windup_deg,law_off_percent" >"$work/out.csv"
echo "$cases" | while IFS='|' read -r name variant torque mesh torques words; do
    "$tool" export "$design" --format calculix --variant "$variant" --torque "$torque" --mesh "$mesh" \
        -o "$work/$name.new"
    if [ -f "$work/$name.dat" ] && cmp -s "$work/$name.new" "$work/$name.inp"; then
        rm "$work/$name.new"
    else
        mv "$work/$name.new" "$work/$name.inp"
        rm -f "$work/$name.dat"
        (cd "$work" && ccx -i "$name" >"$name.log" 2>&1) ||
            { echo "ccx failed on $name:" >&2; tail -n 20 "$work/$name.log" >&2; exit 3; }
    fi
    "$tool" export "$design" --format calculix --read "$work/$name.dat" --torques "$torques" --csv "$work/$name.csv" --quiet >/dev/null
    # The model's name in the reference is quoted and has commas: take it off before splitting.
    awk -F, -v name="$name" -v mesh="$mesh" -v words="$words" '
        NR == FNR {
            if (index($0, words)) { sub(/^"[^"]*",/, ""); n[$1 + 0] = $2; w[$1 + 0] = $3; p[$1 + 0] = $4; t[$1 + 0] = $5 }
            next
        }
        FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        {
            q = $at["torque_nm"] + 0
            if (!(q in w)) { print "no reference row at " q " Nm" > "/dev/stderr"; exit 3 }
            v = $at["windup_deg"]; l = $at["law_windup_deg"] + $at["races_twist_deg"]
            printf "%s,%s,%g,%.1f,%s,%.4f,%s,%.2f,%.5f,%s,%.0f,%s,%.4f,%.2f\n", name, mesh, q, $at["normal_inner_n"], n[q], v, w[q],
                100 * (v / w[q] - 1), $at["tan_omega"], t[q], $at["hertz_inner_mpa"], p[q], l, 100 * (l / v - 1)
        }' "$reference" "$work/$name.csv" >>"$work/out.csv"
    asked=$(echo "$torques" | tr ',' '\n' | wc -l)
    [ "$(wc -l <"$work/$name.csv")" -eq $((asked + 1)) ] ||
        { echo "$name: ccx stopped before the last torque; see $work/$name.log" >&2; exit 3; }
done
cp "$work/out.csv" "$out"
{
    echo "$("$tool" --version), ccx $version; design hash $(sha256sum "$design" | cut -c1-12); remade by \`sh reports/validate_calculix.sh${1:+ $1}\`."
    echo
    echo "# CalculiX against the reference, single-arc clutch"
    echo
    echo "Reference: tests/reference/fem_single_arc.csv, an independent CalculiX model of the same sector. Windup: rim against bore. Law: the contact law named in the design, with the torsion of the races out to rim and bore. p0: mean over an element under the track, half a spacing deep."
    echo
    awk -F, 'NR == 1 { gsub(",", " | "); print "| " $0 " |"; s = "|"; for (i = 0; i < 14; i++) s = s "---|"; print s; next } { gsub(",", " | "); print "| " $0 " |" }' "$out"
} >reports/calculix-single-arc.md
cat reports/calculix-single-arc.md
awk -F, 'NR > 1 && ($8 > 1 || $8 < -1) { bad = 1; print "windup off by " $8 " %: " $1 " at " $3 " Nm" } END { if (NR < 2) bad = 1; exit bad }' "$out" >&2
