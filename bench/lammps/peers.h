/* The time that bond_style bpm/peri of LAMMPS (September 2026 and later) takes beside pair_style peri. */
#ifndef CLEAVE_PEERS
#define CLEAVE_PEERS

#include "base/base.h"

#define PEERS_FOLDER BENCH_FOLDER "/run-peers"

/* Returns true if the program `lmp` on the path lists bond_style bpm/peri among its styles. */
bool peer_has_bond_style(void);

/* Returns the speed of bond_style bpm/peri of LAMMPS divided by that of pair_style peri/pmb, or of peri/lps if
 * `state_based` is true, by the table of the authors of the style (LAMMPS, pull request 5045, 2026, table 3). */
double peer_bond_style_speed_ratio(bool state_based);

/* Runs LAMMPS (`lmp -in input_name -log log_name`) in the folder `folder`. input_name: file name of the input script;
 * log_name: file name of the log. Returns FAILED if lmp cannot be started or fails. */
status peer_run_lammps(const char *folder, const char *input_name, const char *log_name);

/* Reads the loop time from the LAMMPS log file `log_path` of a run of `step_count` steps and stores the time of a step
 * in *seconds [s]. Returns FAILED if the log does not contain it. */
status peer_read_seconds_per_step(const char *log_path, int step_count, double *seconds);

/* Exports a scene for bond_style bpm/peri to PEERS_FOLDER, runs it in LAMMPS and stores the time of a step in *seconds
 * [s]. scene_text: the scene; step_count: its number of time steps. Returns REFUSED if the scene cannot be exported,
 * FAILED if LAMMPS fails. */
status peer_export_and_time_scene(const char *scene_text, int step_count, double *seconds);

#endif
