#!/bin/sh
# Energies over 1e5 and 1e6 steps: the scenes of test_energy_drift and test_limits with all their steps; two minutes.
build=${BUILD:-build}
export LONG=yes
"$build/tests/physics/test_energy_drift" && "$build/tests/physics/test_limits"
