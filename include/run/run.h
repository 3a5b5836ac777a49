#ifndef CLEAVE_RUN
#define CLEAVE_RUN

#include "base/team.h"
#include "base/warnings.h"
#include "bonds/bonds.h"
#include "bonds/surface.h"
#include "data/cells.h"
#include "data/particles.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "run/ledger.h"
#include "scene/scene.h"

/* Time, time steps and load steps of a run. */
struct run_clock {
    real t, dt, dt_critical; /* time, time step, critical time step [s] */
    int64_t step, steps;     /* steps done; steps of the whole run */
    int64_t load_step;       /* number of the load step in progress or just done; 0: none */
    real dt_bears;           /* stable time step of the body, also known in runs with load steps [s] */
    /* steps after which all levels of cells are at the same time: interval of samples and frames */
    int stride;
};

/* Constants of the materials, and the arrays to which struct bond_source and struct mesh_source of the run point. Owned
 * by the run. */
struct material_tables {
    struct elastic *elastic;               /* [materials] elastic constants of material points */
    struct state_modulus *modulus;         /* [materials] moduli of state-based models; NULL: bond-based model */
    real *pair_stretch;                    /* [materials^2] critical stretch of bonds between two materials [1] */
    struct softening_pair *pair_softening; /* [materials^2] softening of these bonds; NULL: none soften */
    struct softening_curve curve;          /* force over stretch of bonds that soften */
    /* [materials^2] yield stretch and hardening modulus of bonds between two materials [1]; NULL: no bond yields */
    real *pair_yield, *pair_hardening;
    int *mirror_axis;                 /* [boundaries] axis of a mirror; -1: clamped */
    struct mirror_plane *mirror;      /* planes of symmetry (source.mirrors) */
    struct crack_list cracks;         /* pre-cracks and their mirror images */
    struct voids voids;               /* voids and notches of bodies that are not convex, which cut bonds */
    struct mirror_plane *void_mirror; /* planes beyond which bodies have images, clamped planes included */
    real *neighbour_volume; /* [n_all] volume of the neighbours of each particle, only pd.surface volume [m^3] */
    struct surface_correction surface; /* weights of bonds near faces, only pd.surface moments */
    struct impedance *impedance;       /* [MOVERS][materials] impedance of absorbing faces; NULL: no such faces */
    real wave_speed;                   /* largest longitudinal wave speed of the materials [m/s] */
};

/* All data of a run. Data that all parts use are stored by value. Each part (contact, probes and others) is a pointer
 * to a type whose members are visible only to files that include its header. The engine makes and releases the run
 * (make.c); pointers to parts are NULL until their part is made. */
struct run {
    const struct scene *scene; /* kept by reference */
    struct kernels kernels;    /* loops for the scene's dimension, model and shape function */
    struct run_clock clock;    /* time, time step and number of the step */
    struct particles part;     /* particles of all bodies */
    int optional;              /* optional arrays of the particles: sum of WITH_* (data/particles.h) */
    struct cells cells;        /* neighbour search in the reference configuration */
    struct material_tables tables;
    struct bond_source source; /* rules by which bonds are made */
    struct bonds bonds;
    struct loads loads;          /* boundary conditions, with the particles on which they act */
    struct boundary *boundary;   /* [boundaries] static problem: copies of the scene's boundary conditions, as functions
                                    of the pseudo-time (loads_static.c) */
    enum coupling coupling_kind; /* coupling of the scene; hand-shake unless the method is adaptive */
    real mass;                   /* mass of all particles [kg] */
    /* energy dissipated so far by damping, friction on the grid, and conversion and splitting of cells [J] */
    real damped;
    struct warnings warnings;        /* warnings of the set-up and of the run, printed and stored */
    struct timers timers;            /* wall-clock time by section of a step */
    struct grid_method *grid;        /* material points on the grid of the current frame: grid/grid_part.h */
    struct lagrangian_mesh *frame;   /* bodies in the reference frame: mesh/mesh_part.h */
    struct rigid_set *rigid;         /* rigid bodies: rigid/rigid_part.h */
    struct contact *contact;         /* contact between particles: contact/contact.h */
    struct coupling_state *coupling; /* conversion of material points, and back: coupling/coupling_part.h */
    struct fracture_state *fracture; /* cracks: fracture/fracture_part.h */
    struct static_solver *solver;    /* one static equilibrium: solver/solver.h */
    struct diagnostics *diagnostics; /* balance of energy and momentum: probes/diagnostics.h */
    struct probing *probing;         /* probes: probes/probes_part.h */
    struct viscosity *viscosity;     /* bulk viscosity in shocks: step/viscosity.h */
    struct damping_state *damping;   /* damping of the whole body: step/damping.h */
    struct stability *stability;     /* check that the run is stable: step/stability.h */
    struct run_report *report;       /* samples, checkpoints, progress lines: step/report.h */
    struct statics *statics;         /* load steps: quasistatic/statics.h */
    const struct part *const *parts; /* table of all parts, terminated by NULL: run/part.h */
    /* saves the state between two steps to the archive a, or restores it; FAILED, with a message, if a file fails */
    status (*save)(void *run, struct archive *a);
};

#endif
