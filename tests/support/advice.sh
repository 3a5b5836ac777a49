# What `cleave check` says of a scene; its output is in $work/said.

# says WHAT PATTERN SCENE [ARGUMENT...]: checks that the pattern is in the output of check for the scene. silent: that it is not.
checked() { "$cleave" check "$@" --no-trial >"$work/said" 2>&1; }
says() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what: $(cat "$work/said")" grep -q "$pattern" "$work/said"; }
silent() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what" sh -c "grep -q 'is sound$\|can be run[;,]' '$work/said' && ! grep -q '$pattern' '$work/said'"; }
