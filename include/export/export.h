/* Room `export`: scenes for other engines. It knows the engine and all below it, reads a scene, makes its particles and
 * bonds, and writes them in another program's words; only commands call it.
 *
 * LAMMPS: the peridynamics of a scene for a machine, or many, that Cleave does not reach, and a second opinion on it.
 */
#ifndef CLEAVE_EXPORT
#define CLEAVE_EXPORT

#include "base/base.h"
#include "scene/scene.h"

/* What is exported where. */
struct export_request {
    const char *scene, *folder; /* borrowed */
    const struct scene_override *override;
    int overrides;
    bool bond_style;      /* for bond_style bpm/peri (2026), else pair_style peri/pmb, peri/lps (2021) */
    bool allow_different; /* what LAMMPS has otherwise is exported LAMMPS' way */
    bool overwrite;       /* replaces an older export in the folder */
};

/* Writes in.lammps, plate.data, README.txt, scene.yaml and check.csv into the folder, and prints what the run there
 * costs. REFUSED, in a line with the reason, if LAMMPS cannot run the scene, or not to the same result, or if the
 * folder holds files of others, or an export and `overwrite` is not set; nothing is written then. */
status export_lammps(const struct export_request *request);

#endif
