/* A part of `cleave bench peers`. */
#ifndef CLEAVE_BENCH_PEERS_BAR
#define CLEAVE_BENCH_PEERS_BAR

#include "base/base.h"

/* Times a copper Taylor bar that yields and one that does not, prints both beside the recorded time of MPM3D-F90 and
 * writes peers_bar.csv. quick: coarse and short. Returns FAILED if a run or a file fails. */
status peers_bar(bool quick);

#endif
