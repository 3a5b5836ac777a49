#!/bin/sh
# Small scenes of every kind (tests/robustness/small_scenes.txt) and the other commands (small_commands.txt beside it), for tests that run
# all of them under a tool. Sourced after summary.sh.

# Expands the list to NAME|FILE|KEY=VALUE;KEY=VALUE;... with all settings of each scene.
sed 's/ *| */|/g; s/; */;/g; s/ *$//; /^#/d' tests/robustness/small_scenes.txt | awk -F'|' -v OFS='|' '
    $2 in file { $3 = settings[$2] ($3 == "" ? "" : ";" $3); $2 = file[$2] }
    { file[$1] = $2; settings[$1] = $3; print }' >"$work/small_scenes"

# call_with FILE SETTINGS COMMAND...: runs COMMAND FILE -s KEY=VALUE ..., with the settings KEY=VALUE;KEY=VALUE;...
call_with()
{
    scene_file=$1 rest=$2; shift 2
    set -- "$@" "$scene_file"
    while [ -n "$rest" ]; do
        setting=${rest%%;*}
        rest=${rest#"$setting"}
        rest=${rest#;}
        [ -z "$setting" ] || set -- "$@" -s "$setting"
    done
    "$@"
}

# each_scene PATTERN COMMAND...: runs COMMAND NAME FILE -s KEY=VALUE ... for every scene whose name matches the pattern.
each_scene()
{
    pattern=$1; shift
    awk -F'|' -v pattern="$pattern" '$1 ~ pattern' "$work/small_scenes" >"$work/each_scene"
    while IFS='|' read -r name file settings <&3; do call_with "$file" "$settings" "$@" "$name"; done 3<"$work/each_scene"
}

# each_command COMMAND...: runs COMMAND STATUS WHAT ARGUMENT... for every line of small_commands.txt, in order: expected exit status, the
# line, and the arguments of cleave. @ in a line becomes the folder $work/c.
each_command()
{
    mkdir -p "$work/c"
    sed "/^#/d; s|@|$work/c|g" tests/robustness/small_commands.txt >"$work/each_command"
    while read -r wanted words <&4; do
        case $words in plot*) command -v gnuplot >/dev/null || continue ;; esac
        set -f
        "$@" "$wanted" "$words" $words
        set +f
    done 4<"$work/each_command"
}

# instrumented FOLDER FLAGS SETTING...: builds the program in FOLDER with these compiler flags and settings of make, for a tool such as a
# sanitizer, and sets $cleave to it.
instrumented()
{
    folder=$1 flags=$2; shift 2
    if ! MAKEFLAGS= CFLAGS="$flags" CPPFLAGS="-DLEAVE=exit -DCLEAVE_ASSERT" make -j2 BUILD=$folder "$@" >"$work/said" 2>&1; then
        fail "no build in $folder: $(cat "$work/said")"
        finish
    fi
    cleave=$root/$folder/cleave
}
