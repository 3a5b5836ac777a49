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

/* Constants of the materials, and the arrays that `source` of the bonds refers to. */
struct material_tables {
    struct elastic *elastic;               /* [materials] */
    struct state_modulus *modulus;         /* [materials] of state-based models, else NULL */
    real *pair_stretch;                    /* [materials^2] critical stretch of bonds between two materials */
    struct softening_pair *pair_softening; /* [materials^2] softening of these bonds; NULL: none soften */
    struct softening_curve curve;          /* of bonds that soften */
    /* [materials^2] yield stretch and hardening of bonds between two materials; NULL: elastic */
    real *pair_yield, *pair_hardening;
    int *mirror_axis;                 /* [boundaries] axis of a mirror; -1: clamped */
    struct mirror_plane *mirror;      /* planes of symmetry */
    struct crack_list cracks;         /* pre-cracks and their mirror images */
    struct voids voids;               /* of bodies that are not convex */
    struct mirror_plane *void_mirror; /* planes beyond which bodies have images, clamped ones included */
    real *neighbour_volume;           /* [n_all] V^H of every particle, pd.surface volume only */
    struct surface_weights surface;   /* weights of bonds near faces, pd.surface moments only */
    struct impedance *impedance;      /* [MOVERS][materials] of absorbing faces; NULL: no such faces */
    real wave_speed;                  /* largest longitudinal wave speed of the materials [m/s] */
};

/* Data of a run: the members that all parts work on, by value, and the parts of the run, each a pointer to a type whose
 * definition only files that include its header see. Made and released by the engine (make.c); a part is NULL
 * before. */
struct run {
    const struct scene *scene; /* kept by reference */
    struct kernels kernels;
    struct run_clock clock;
    struct particles part;
    int optional;       /* WITH_* arrays of the particles (data/particles.h) */
    struct cells cells; /* neighbour search in the reference configuration */
    struct material_tables tables;
    struct bond_source source;
    struct bonds bonds;
    struct loads loads;
    struct boundary *boundary;   /* [boundaries] of a static problem, in its pseudo-time (loads_static.c) */
    enum coupling coupling_kind; /* of the scene; hand-shake unless the method is adaptive */
    real mass;                   /* of the body [kg] */
    /* energy dissipated so far by damping, friction on the grid, and conversion and splitting of cells [J] */
    real damped;
    struct warnings warnings; /* of the set-up and of the run */
    struct timers timers;
    struct grid_method *grid;        /* material points on the grid of the current frame: grid/grid_part.h */
    struct reference_frame *frame;   /* bodies in the reference frame: mesh/mesh_part.h */
    struct rigid_set *rigid;         /* rigid/rigid_part.h */
    struct contact *contact;         /* contact/contact.h */
    struct coupling_state *coupling; /* coupling/coupling_part.h */
    struct fracture_state *fracture; /* cracks: fracture/fracture_part.h */
    struct static_solver *solver;    /* solver/solver.h */
    struct diagnostics *diagnostics; /* balance of energy and momentum: probes/diagnostics.h */
    struct probing *probing;         /* probes/probes_part.h */
    struct viscosity *viscosity;     /* of shocks: step/viscosity.h */
    struct damping_state *damping;   /* of the bulk: step/damping.h */
    struct stability *stability;     /* step/stability.h */
    struct run_report *report;       /* step/report.h */
    struct statics *statics;         /* load steps: quasistatic/statics.h */
    const struct part *const *parts; /* table of all parts, terminated by NULL: run/part.h */
    status (*save)(void *run, struct archive *a); /* saves or restores the state between two steps */
};

#endif
