#!/bin/sh
# Shipped scenes must answer the advice of `cleave check`: for each line of accuracy and hints they have a comment
#     # check: WORDS: REASON
# whose words are in that line. One comment may answer several lines; a comment that answers none is an error. No scene may cause a
# warning unless its key `accept` names it.
test_name=test_shipped_scenes
. tests/support/summary.sh

# unanswered SCENE SAID: prints the lines of advice in the file SAID that no comment of the scene answers, and the comments that answer
# none.
unanswered()
{
    awk '
        FILENAME == ARGV[1] { if (/^(accuracy|hints) /) advice[++lines] = $0; hints = /^hints/ || (hints && /^  /)
            if (hints && /^  /) advice[++lines] = $0; next }
        !/^ *# check: / { next }
        {
            words = $0; sub(/^ *# check: /, "", words); at = index(words, ": ")
            reason = at ? substr(words, at + 2) : ""; words = at ? substr(words, 1, at - 1) : words; used = 0
            for (k = 1; k <= lines; k++) if (index(advice[k], words)) used = answered[k] = 1
            if (!used) print "answers nothing: " $0
            if (length(reason) < 10) print "gives no reason: " $0
        }
        END { for (k = 1; k <= lines; k++) if (!answered[k]) print "unanswered: " advice[k] }' "$2" "$1"
}

# Two at a time. The largest scene takes as long as all others: it is checked at a larger spacing, with the same advice.
cat >"$work/say" <<'END'
said=$2/$(basename "$3" .yaml)
case $3 in *kalthoff_3d_fine*) set -- "$1" "$2" "$3" -s particles.spacing=10/14mm -s mpm.fill=auto ;; esac
cleave=$1
shift 2
"$cleave" check "$@" --no-trial -t 1 >"$said" 2>&1 || echo failed >>"$said"
END
printf '%s\n' inputs/*.yaml | xargs -P 2 -n 1 sh "$work/say" "$cleave" "$work"
for scene in inputs/*.yaml; do
    said=$work/$(basename "$scene" .yaml)
    holds "$scene: $(cat "$said")" grep -q ' is sound$\| can be run[;,]' "$said"
    is "$scene: $(tail -n 1 "$said")" "$(grep -c '^failed$' "$said")" 0
    is "$scene" "$(unanswered "$scene" "$said")" ""
    is "$scene: warnings" "$(grep '^warning' "$said")" ""
done

# The scenes whose accept names warnings of a run: silent with it, each warning with its own remedy without it.
said_by() { "$cleave" run "$@" -q -t 1 -o "$work/run" --overwrite 2>&1 >/dev/null; }
is "hopkinson_bar" "$(said_by inputs/hopkinson_bar.yaml)" ""
said_by inputs/hopkinson_bar.yaml -s 'accept=none' >"$work/said"
is "hopkinson_bar without accept: $(cat "$work/said")" "$(grep -c '^warning: .*; if this is intended, add accept: \[' "$work/said")" 3
holds "points that stretch: no remedy that the scene refuses" grep -q 'stretched by .* use method: pd, or smaller loads and speeds (mpm.frame: reference is no remedy: bodies have contact only on the grid' \
    "$work/said"
is "bar_spall" "$(said_by inputs/bar_spall.yaml)" ""
said_by inputs/bar_spall.yaml -s 'accept=none' >"$work/said"
is "bar_spall without accept: $(cat "$work/said")" "$(grep -c '^warning: .*; if this is intended, add accept: \[' "$work/said")" 3

# The comparison itself detects missing and superfluous comments.
printf 'accuracy       own mirror image at x = 0\nhints          another one\n               own mirror image at y = 0\n' >"$work/said"
printf '# check: own mirror image: both halves are shown\n# check: another one: to be read\n' >"$work/scene"
is "one comment for two lines" "$(unanswered "$work/scene" "$work/said")" ""
printf '# check: image at x: both halves are shown\n# check: another one: to be read\n' >"$work/scene"
is "a line without comment" "$(unanswered "$work/scene" "$work/said")" "unanswered:                own mirror image at y = 0"
printf '# check: own mirror image: both halves are shown\n# check: another one: to be read\n  # check: method pd: a reason of old\n# check: own mirror image\n' >"$work/scene"
is "comments without line or reason" "$(unanswered "$work/scene" "$work/said" | cut -c 1-16 | tr '\n' ' ')" \
    "answers nothing: gives no reason: "
: >"$work/said"
is "no advice, a comment" "$(unanswered "$work/scene" "$work/said" | grep -c '^answers nothing')" 4

finish
