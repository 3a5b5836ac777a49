/* Room `engine` (folder of include/ and src/): a run as a whole: set-up, time loop, checkpoints, warnings, summary. It
 * uses every room below it (order in tests/house.sh); commands and benches call it. */
#ifndef CLEAVE_ENGINE
#define CLEAVE_ENGINE

#include "output/output.h"
#include "run/critical_step.h"
#include "run/run.h"

/* Creates in *run the state of a run of the scene s before the first step: particles, cells, loads, bonds, grid, time
 * step. output: files of the run, opened by output_open and kept by reference; NULL for a run without files. Returns
 * REFUSED if the scene is invalid or needs more memory than available; FAILED if a file cannot be read. Release *run
 * with run_free_memory whatever is returned. */
status run_set_up_from_scene(struct run *run, const struct scene *s, struct output *output);

/* Releases all memory of the run. Waits first for the thread that may still be writing a frame (output file of one
 * time). */
void run_free_memory(struct run *run);

/* Writes a line on standard error if the set-up of scene s will take longer than some seconds, because its bodies have
 * very many lattice positions: the number of positions, which follows from volume and spacing, and the expected
 * time. */
void run_print_notice_if_set_up_takes_long(const struct scene *s);

/* Returns an estimate of the peak memory [byte] of a run of scene s, whose bodies consist of particles on lattices. p:
 * particles of these bodies; source: materials and neighbourhood sizes. Bonds and grids need not exist yet. */
real run_estimate_peak_memory(const struct scene *s, const struct particles *p, const struct bond_source *source);

/* Returns an estimate of the peak memory [byte] of a run of scene s as run_estimate_peak_memory does, but for the case
 * that all particles p become peridynamic. source: materials and neighbourhood sizes. */
real run_estimate_peak_memory_if_all_peridynamic(const struct scene *s, const struct particles *p,
                                                 const struct bond_source *source);

/* Runs the scene of the run, which run_set_up_from_scene has prepared, from the present step to its end, with all
 * reports. Returns OK at the end; INTERRUPTED, after a checkpoint, if a signal or the wall-clock limit stops the run;
 * FAILED if the run becomes unstable, no equilibrium is found, or a file cannot be written. */
status run_advance_to_end_time(struct run *run);

/* Adapts the coarsening levels of the mesh cells of the run (0: finest; the edge of a cell doubles with each level) to
 * the present state, then makes one time step. Returns FAILED, with a message, if one of the two fails. */
status run_adapt_mesh_and_advance_one_step(struct run *run);

/* Saves the complete state of a run between two steps to the archive a (checkpoint file or memory) if a->saving is
 * true, else restores it from the archive. run: pointer to the struct run. Returns FAILED if the file cannot be
 * written, or if the stored state does not fit the run or is inconsistent. */
status run_save_or_load_state(void *run, struct archive *a);

/* Restores the state of a run from a checkpoint, which the archive a reads. run: pointer to a struct run of the same
 * scene that run_set_up_from_scene has created. Reports on standard error if the checkpoint was written with another
 * instruction set. Returns FAILED if the checkpoint belongs to another body or is inconsistent. */
status run_load_checkpoint(void *run, struct archive *a);

/* Runs the scene of the run once more with material points alone, if it has a PULSE probe (wave packet at an
 * interface). The final velocities and the energy change of the second run are stored, and the probe compares the run
 * with them. Call this function at the end of the run. Returns the status of the second run; OK if there is no PULSE
 * probe. */
status run_repeat_with_mpm_only_for_pulse_probe(struct run *run);

/* Checks the scene of the run for input that is allowed but probably unintended, and adds warnings to run->warnings.
 * Call it once, before the first step. */
void run_warn_of_suspicious_input(struct run *run);

/* Writes the files summary.json and, if bodies can break into fragments, fragments.csv of the run for the steps done so
 * far. Does nothing for a run without files. end_status: status with which the run ended; thread_count: number of
 * threads. Returns FAILED if a file cannot be written. */
status run_write_summary_files(const struct run *run, status end_status, int thread_count);

#endif
