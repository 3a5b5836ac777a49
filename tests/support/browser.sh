# Sourced by tests of pages, after summary.sh: opens pages of `cleave report` in Chromium. $browser: its command, empty if there is none.
browser=
for name in chromium chromium-browser google-chrome; do [ -n "$browser" ] || browser=$(command -v $name || true); done

# chrome ARGUMENTS: runs Chromium without window and network; its messages are in $work/console.
chrome()
{
    timeout 300 "$browser" --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$work/profile" --proxy-server=127.0.0.1:9 \
        --window-size=1200,1500 --virtual-time-budget=30000 "$@" 2>"$work/console"
}

# seen NAME: opens the report of the run $work/NAME and stores what report_probe.js finds on the page in $work/NAME.json.
seen()
{
    { sed 's|<head>|&<script>const problems = []; for (const e of ["error", "securitypolicyviolation"]) addEventListener(e, (what) => problems.push(e + ": " + (what.message \|\| what.violatedDirective)), true); console.error = (what) => problems.push(String(what));</script>|' \
        "$work/$1/report.html"; echo "<script>"; cat "$root/tests/scenes/report_probe.js"; echo "</script>"; } >"$work/$1/probe.html"
    chrome --dump-dom "file://$work/$1/probe.html" | tr -d '\n' | sed 's/.*SEEN \(.*\) END.*/\1/; s/&lt;/</g; s/&gt;/>/g; s/&amp;/\&/g' >"$work/$1.json"
}
# The interpreter itself, without modules of other origin: `python3` may be a script that first looks for one, which takes twenty times as long.
interpreter="$(python3 -c 'import sys; print(sys.executable)') -S"
# says NAME EXPRESSION: checks that a Python expression of s, the contents of $work/NAME.json, is true.
says() { $interpreter -c "import json, sys; s = json.load(open('$work/$1.json')); sys.exit(0 if $2 else 1)" 2>/dev/null && pass || fail "$1: not $2: $(cut -c1-1500 "$work/$1.json")"; }
