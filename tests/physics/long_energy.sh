#!/bin/sh
# Runs test_energy_drift and test_limits with LONG set: all scenes, with up to 1e5 steps for energy drift and 1e6 steps for limits. Takes
# two minutes.
build=${BUILD:-build}
export LONG=yes
"$build/tests/physics/test_energy_drift" && "$build/tests/physics/test_limits"
