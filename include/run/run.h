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

/* Where a run is in time. */
struct run_clock {
    real t, dt, dt_critical; /* [s] */
    int64_t step, steps;     /* done; of the whole run */
    int64_t load_step;       /* the one at hand or just done; 0: none */
    real dt_bears;           /* step in time that the body would bear; of load steps, too [s] */
    int stride;              /* steps after which all levels of cells are at one time: samples, frames */
};

/* Constants by material, and the arrays that `source` of the bonds points to. */
struct material_tables {
    struct elastic *elastic;           /* [materials] */
    struct state_modulus *modulus;     /* [materials] of state-based models, else NULL */
    real *pair_stretch;                /* [materials^2] critical stretch of a pair of materials */
    real *pair_yield, *pair_hardening; /* [materials^2] of bonds between two materials; NULL: elastic */
    int *mirror_axis;                  /* [boundaries] -1: clamped */
    struct mirror_plane *mirror;       /* planes of symmetry */
    struct crack_list cracks;          /* pre-cracks with their images in these */
    struct voids voids;                /* of bodies that are not convex */
    struct mirror_plane *void_mirror;  /* planes beyond which bodies have images, clamped ones among them */
    real *neighbour_volume;            /* [n_all] V^H of every particle, volume method only */
    struct surface_weights surface;    /* of bonds near faces, pd.surface moments only */
    struct impedance *impedance;       /* [movers][materials] of absorbing faces; NULL: there are none */
    real wave_speed;                   /* fastest of the materials [m/s] */
};

/* What all parts of a run work on, by value, and its parts, each of which only those files look into that include its
 * header. Made and freed by the engine (make.c); a part is NULL until then. */
struct run {
    const struct scene *scene; /* borrowed */
    struct kernels kernels;
    struct run_clock clock;
    struct particles part;
    int optional;       /* WITH_* arrays of the particles */
    struct cells cells; /* search over reference positions */
    struct material_tables tables;
    struct bond_source source;
    struct bonds bonds;
    struct loads loads;
    struct boundary *boundary;   /* of a static problem, in its pseudo-time (loads_static.c) */
    enum coupling coupling_kind; /* of the scene; hand-shake where nothing meets */
    real mass;                   /* of the body [kg] */
    real damped;                 /* energy that damping and conversion of moving cells took so far [J] */
    struct warnings warnings;    /* what engine_warn and the run found */
    struct laps laps;
    struct grid_method *grid;        /* material points on the grid of the current frame: grid/grid_part.h */
    struct reference_frame *frame;   /* bodies in the reference frame: mesh/mesh_part.h */
    struct rigid_set *rigid;         /* rigid/rigid_part.h */
    struct contact *contact;         /* contact/contact.h */
    struct coupling_state *coupling; /* coupling/coupling_part.h */
    struct fracture_state *fracture; /* cracks: fracture/fracture_part.h */
    struct solver *solver;           /* solver/solver.h */
    struct diagnostics *diagnostics; /* balance of energy and momentum: probes/diagnostics.h */
    struct probing *probing;         /* probes/probes_part.h */
    struct viscosity *viscosity;     /* of shocks: step/viscosity.h */
    struct damping_state *damping;   /* of the bulk: step/damping.h */
    struct stability *stability;     /* step/stability.h */
    struct run_report *report;       /* step/report.h */
    struct statics *statics;         /* load steps: quasistatic/statics.h */
    const struct part *const *parts; /* all of them, up to NULL: run/part.h */
    status (*save)(void *run, struct archive *a); /* saves or restores the state between two steps */
};

#endif
