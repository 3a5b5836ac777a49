# Functions for checks of the messages of `cleave check`; its output is in $work/said.

# checked SCENE [ARGUMENT...]: runs `cleave check` for the scene. says WHAT PATTERN SCENE [ARGUMENT...]: checks that its output contains the
# pattern. silent WHAT PATTERN SCENE [ARGUMENT...]: checks that the scene is accepted and that the output does not contain it.
checked() { "$cleave" check "$@" --no-trial >"$work/said" 2>&1; }
says() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what: $(cat "$work/said")" grep -q "$pattern" "$work/said"; }
silent() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what" sh -c "grep -q 'is sound$\|can be run[;,]' '$work/said' && ! grep -q '$pattern' '$work/said'"; }
