/* `cleave bench kernels`: times every kernel instance on one thread and compares it with the limits of the machine.
 * Measurements of limits and kernels alternate; the fastest repetition counts. */
#include <math.h>
#include <string.h>

#include "kernel_bench.h"
#include "base/memory.h"
#include "kernels/simd/variants.h"
#include "contact/contact.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"

#define BOND_JOBS(D, M)                                                                                                \
    {BOND_FORCE, D, .model = PD_##M, .variant = #M}, {BOND_ENERGY, D, .model = PD_##M, .variant = #M},                 \
        {BOND_STRESS, D, .model = PD_##M, .variant = #M},
#define DIM_JOBS(D)                                                                                                    \
    {PD_MOVE, D, .variant = "-"}, {GRID_CLEAR, D, .variant = "-"}, {GRID_MOVE, D, .variant = "-"},                     \
        {GRID_REMAPPED, D, .variant = "-"}, {MESH_CLEAR, D, .variant = "-"}, {MESH_MOVE, D, .variant = "-"},           \
        {MESH_FORCE, D, .variant = "SMALL"}, {MESH_FORCE, D, .variant = "FINITE", .finite = true},                     \
        {CONTACT_SEARCH, D, .variant = "faces pressed"}, {CONTACT_FORCE, D, .variant = "faces pressed"},
#define SHAPE_JOBS(D, S, C)                                                                                            \
    {REMAP, D, .shape = SHAPE_##S, .variant = #S " FLIP"}, {SPREAD, D, .shape = SHAPE_##S, .variant = #S},
#define TRANSFER_JOB(D, S, T)                                                                                          \
    {P2G, D, .shape = SHAPE_##S, .transfer = TRANSFER_##T, .variant = #S " " #T},                                      \
        {G2P, D, .shape = SHAPE_##S, .transfer = TRANSFER_##T, .variant = #S " " #T},
#define YIELDING_JOBS(D) {G2P_YIELDS, D, .shape = SHAPE_LINEAR, .transfer = TRANSFER_FLIP, .variant = "LINEAR FLIP"},
#define TRANSFER_JOBS(D, S, C) TRANSFER_VARIANTS(TRANSFER_JOB, D, S)

static const struct job all_jobs[] = {PD_VARIANTS(BOND_JOBS) STATE_VARIANTS(BOND_JOBS) DIM_VARIANTS(
    DIM_JOBS) SHAPE_VARIANTS(SHAPE_JOBS) SHAPE_VARIANTS(TRANSFER_JOBS) DIM_VARIANTS(YIELDING_JOBS)};

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

/* Creates the run of a body of about 80,000 particles with spacing 0.5 mm in which no bond breaks, with its scene in
 * *s, and makes one step. dim: its dimension; method, model, mpm: values of these scene keys; more: further keys of the
 * scene; yields: true if the material has a yield stress. Returns FAILED if the step fails. Release with
 * bench_engine_free. */
static status kernels_body_make(struct run *run, struct scene *s, int dim, const char *method, const char *model,
                                const char *mpm, const char *more, bool yields)
{
    static const char *const space[DIM_MAX + 1] = {NULL, "line\nsection: 1 mm^2", "plane stress\nthickness: 10 mm",
                                                   "solid"};
    static const char *const size[DIM_MAX + 1] = {NULL, "[40 m]", "[100 mm, 200 mm]", "[20 mm, 20 mm, 25 mm]"};
    static const char *const poisson[DIM_MAX + 1] = {NULL, "", "poisson: 1/3, ", "poisson: 1/4, "};
    static const char *const corner[DIM_MAX + 1] = {NULL, "[0]", "[0, 0]", "[0, 0, 0]"};
    char text[1024];
    snprintf(text, sizeof text,
             "name: bench\nspace: %s\nduration: 1 us\nmethod: %s\nmodel: %s\nmaterial: {name: steel, young: 190 GPa, "
             "%sdensity: 7800%s}\n"
             "body:\n  - box: {from: %s, to: %s}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n"
             "mpm: {%s}\noutput: {samples: 1, frames: 0}\ntime: {active_set: false}\n%s",
             space[dim], method, model, poisson[dim], yields ? ", yield_stress: 1 GPa" : "", corner[dim], size[dim],
             mpm, more);
    TRY(bench_engine_make(run, s, "bench", text, NULL, 0));
    for (int d = 0; d < dim; d++)
        for (int64_t i = 0; i < run->part.n; i++) {
            run->part.v[d][i] = 1e-3 * sin((real)i);
            run->part.x[d][i] += 1e-8 * sin((real)(i + d));
        }
    return bench_engine_run(run, 1, NULL); /* sorts the points and covers them with a grid */
}

/* Displaces one half of the body of the run, which a crack cuts in two, by 0.02 spacings towards the other half, so
 * that the crack faces are in contact. */
static void faces_press(struct run *run)
{
    real low, high;
    particles_coordinate_range(&run->part, run->part.n, 0, &low, &high);
    for (int64_t i = 0; i < run->part.n; i++)
        if (run->part.X[0][i] < 0.5 * (low + high)) run->part.x[0][i] += 0.02 * run->scene->spacing;
}

static status ground_make(struct ground *g, int dim)
{
    static const char *const cut[DIM_MAX + 1] = {
        NULL, "cracks: [{at: [20 m]}]\n", "cracks: [{from: [50 mm, -1 mm], to: [50 mm, 201 mm]}]\n",
        "cracks: [{polygon: [[10 mm, -1 mm, -1 mm], [10 mm, 21 mm, -1 mm], [10 mm, 21 mm, 26 mm], "
        "[10 mm, -1 mm, 26 mm]]}]\n"};
    static const char points_of[] = "shape: cpgimp, transfer: apic", mesh[] = "frame: reference";
    TRY(kernels_body_make(&g->engine[BONDS], &g->scene[BONDS], dim, "pd", "bond", points_of, "", false));
    TRY(kernels_body_make(&g->engine[YIELDING], &g->scene[YIELDING], dim, "pd", "bond", points_of, "", true));
    TRY(kernels_body_make(&g->engine[POINTS], &g->scene[POINTS], dim, "mpm", "bond", points_of, "", true));
    if (dim > 1)
        TRY(kernels_body_make(&g->engine[STATES], &g->scene[STATES], dim, "pd", "mospd", points_of, "", false));
    TRY(kernels_body_make(&g->engine[MESH], &g->scene[MESH], dim, "mpm", "bond", mesh, "", false));
    TRY(kernels_body_make(&g->engine[CUT], &g->scene[CUT], dim, "pd", "bond", points_of, cut[dim], false));
    faces_press(&g->engine[CUT]);
    struct run *points = &g->engine[POINTS];
    points->grid->transfer.dt = points->grid->transfer.dt_velocity =
        1e-12; /* repeated calls then do not change the state */
    g->list = NEW("bench.list", points->part.n, int32_t);
    g->value = NEW("bench.value", points->part.n, real);
    g->field = NEW("bench.field", points->grid->field[0].grid.n, real);
    for (int64_t i = 0; i < points->part.n; i++) g->list[i] = (int32_t)i, g->value[i] = 1;
    return OK;
}

static void ground_free(struct ground *g)
{
    for (int k = 0; k < GROUNDS; k++) bench_engine_free(&g->engine[k], &g->scene[k]);
    memory_free(g->list);
    memory_free(g->value);
    memory_free(g->field);
}

/* ---- timing ------------------------------------------------------------------------------------------------------ */

/* Returns the run of g on whose bonds the kernel of job j is timed: bonds of state-based models, of yielding bonds, or
 * of elastic ones. */
static struct run *bonds_of(const struct job *j, struct ground *g)
{
    return &g->engine[j->model >= PD_OSPD ? STATES : j->model == PD_BOND_PLASTIC ? YIELDING : BONDS];
}

/* Calls the kernel of job j that gathers velocities from the grid and moves the material points of the run. yields:
 * true to call it with the yielding material of the run, false with an elastic one. */
static void g2p_call(const struct job *j, struct run *run, bool yields)
{
    struct elastic material = run->tables.elastic[0];
    struct transfer_data t = run->grid->transfer;
    if (!yields) material.law = NULL, t.laws = false;
    t.elastic = &material;
    g2p_table[j->dim][j->shape][j->transfer](&run->grid->field[0].grid, &run->part, &t);
}

/* Sets the stresses of all material points of the run beyond their yield stress and their plastic strain to 0, so that
 * the next call of a kernel has to return the stresses to the yield surface. */
static void points_stress(struct run *run)
{
    const real yield = run->tables.elastic[0].law->yield;
    for (int64_t i = 0; i < run->part.n; i++) run->part.plastic_strain[i] = 0;
    for (int c = 0; c < symmetric_tensor_component_count(run->part.dim); c++)
        for (int64_t i = 0; i < run->part.n; i++) run->part.stress[c][i] = c == 0 ? 2 * yield : 0.1 * yield;
}

/* Updates the list of pairs of particles in contact of the run, as a step does. changed: 1 to enforce a new search
 * for pairs, 0 to keep the list as long as it is valid. */
static void faces_update(struct run *run, int changed)
{
    contact_update_pair_list_if_outdated(run->contact, &run->part, &run->bonds, &run->loads, &run->source.family, 0,
                                         run->contact->broken, run->contact->changed + changed);
}

static void job_call(const struct job *j, struct ground *g)
{
    struct run *pd = bonds_of(j, g), *e = &g->engine[POINTS], *m = &g->engine[MESH], *cut = &g->engine[CUT];
    struct kernels k;
    kernels_choose(&k, j->dim, j->model, j->shape, j->transfer);
    real impulse[DIM_MAX] = {0}, work = 0;
    switch (j->kind) {
    case BOND_FORCE:
        k.bond_force(&pd->bonds, &pd->part, &pd->source.limit, NULL);
        break;
    case BOND_ENERGY:
        k.bond_energy(&pd->bonds, &pd->part, NULL);
        break;
    case BOND_STRESS:
        k.bond_stress(&pd->bonds, &pd->part);
        break;
    case PD_MOVE:
        pd_move_table[j->dim](&pd->part, pd->part.list[KIND_PD], pd->part.n_of[KIND_PD],
                              &(struct pd_motion){1e-12, 1e-12, INFINITY, NULL, false});
        break;
    case P2G:
        p2g_table[j->dim][j->shape][j->transfer](&e->grid->field[0].grid, &e->part, &e->grid->transfer);
        break;
    case REMAP:
        remap_table[j->dim][j->shape](&e->grid->field[0].grid, &e->part, &e->grid->transfer);
        break;
    case G2P:
    case G2P_YIELDS:
        g2p_call(j, e, j->kind == G2P_YIELDS);
        break;
    case SPREAD:
        spread_table[j->dim][j->shape](&e->grid->field[0].grid, &e->part, e->grid->transfer.half_width, g->list,
                                       e->part.n, g->value, g->field);
        break;
    case GRID_CLEAR:
        grid_clear(&e->grid->field[0].grid);
        break;
    case GRID_MOVE:
        grid_advance_and_constrain_nodes(&e->grid->field[0].grid, TRANSFER_FLIP, 1e-12, e->grid->smallest_mass, impulse,
                                         &work);
        break;
    case MESH_CLEAR:
        mesh_clear(&m->frame->mesh);
        break;
    case MESH_FORCE:
        mesh_force(&m->frame->mesh, &m->part, m->frame->elastic, j->finite);
        break;
    case MESH_MOVE:
        mesh_move(&m->frame->mesh, 1e-12, 1e-12, impulse, &work);
        break;
    case CONTACT_SEARCH:
        faces_update(cut, 1);
        break;
    case CONTACT_FORCE:
        faces_update(cut, 0);
        contact_compute_forces(cut->contact, &cut->part, 0);
        break;
    default:
        grid_remapped(&e->grid->field[0].grid, e->grid->smallest_mass);
    }
}

/* Times the kernel of job j in two calls, the first of which fills the caches, and lowers j->seconds to the shorter of
 * their times [s] if it is shorter than in earlier calls. g: bodies on which kernels are timed. */
static void job_time(struct job *j, struct ground *g)
{
    for (int k = 0; k < 2; k++) {
        if (j->kind == G2P_YIELDS) points_stress(&g->engine[POINTS]);
        double start = wall_clock_seconds();
        job_call(j, g);
        j->seconds = fmin(j->seconds, wall_clock_seconds() - start);
    }
}

static void time_all(struct kernel_bench *b, bool quick)
{
    struct microbench_lattice *cell_stencil[DIM_MAX + 1];
    struct microbench_triad *triad = microbench_triad_make(quick);
    struct microbench_points *points = microbench_points_make();
    b->limits = (struct limits){.cell_stencil = {INFINITY, INFINITY, INFINITY, INFINITY}, .points = INFINITY};
    for (int d = 1; d <= DIM_MAX; d++) cell_stencil[d] = microbench_lattice_make(d);
    for (int r = 0; r < (quick ? 2 : 12); r++) {
        for (int k = 0; k < 3; k++) {
            for (int d = 1; d <= DIM_MAX; d++)
                b->limits.cell_stencil[d] = fmin(b->limits.cell_stencil[d], microbench_lattice_run(cell_stencil[d]));
            b->limits.points = fmin(b->limits.points, microbench_points_run(points));
        }
        b->limits.triad = fmax(b->limits.triad, microbench_triad_run(triad));
        for (int k = 0; k < b->jobs; k++) job_time(&b->job[k], &b->ground[b->job[k].dim]);
        for (int d = 1; d <= DIM_MAX; d++) grid_clear(&b->ground[d].engine[POINTS].grid->field[0].grid);
    }
    for (int d = 1; d <= DIM_MAX; d++) microbench_lattice_free(cell_stencil[d]);
    microbench_triad_free(triad);
    microbench_points_free(points);
}

/* ---- bytes ------------------------------------------------------------------------------------------------------- */

/* Returns the mean number of bytes that kernels read from memory per column of a block of eight rows. A block holds the
 * bonds of eight particles, and one of its columns a bond of each. Columns of blocks whose bonds follow a common
 * stencil of the lattice count 0, since the stencil remains in cache. */
static double column_bytes(const struct bonds *b)
{
    double sum = 0;
    for (int64_t g = 0; g < b->row_blocks; g++)
        for (int64_t column = b->column[g]; column < b->column[g] + b->column_count[g] && !b->stencil[g]; column++) {
            const struct bond_column *c = &b->common[column];
            sum += sizeof *c + (c->alike ? 0 : LANES * sizeof *b->w);
            if (!c->shell) sum += LANES * (sizeof *b->inverse_length + (c->first < 0 ? sizeof *b->nbr : 0));
        }
    return sum / (double)b->columns;
}

/* Returns the number of bytes that contact in the run moves per particle near a face: its list of pairs twice,
 * forces, energy and positions. */
static double contact_bytes(const struct run *run)
{
    const struct contact *c = run->contact;
    return 8.0 * (double)c->pairs / (double)c->rows + 2 * sizeof *c->face + 2 * sizeof *c->balance +
           3 * sizeof(real) * (double)run->part.dim;
}

/* Returns the least number of bytes that the kernel of job j moves per particle. Each array that the kernel reads or
 * writes counts once; a grid node counts once for all points that share it. g: bodies on which kernels are timed. */
static double job_bytes(const struct job *j, struct ground *g)
{
    const double mesh_node = sizeof(real) / (double)(1 << j->dim);
    const struct run *run = &g->engine[POINTS], *pd = bonds_of(j, g);
    const double r = sizeof(real), dim = j->dim, symmetric = symmetric_tensor_component_count(j->dim);
    const double node = r * (double)run->grid->field[0].grid.n / (double)run->part.n;
    const double stretch = j->shape == SHAPE_CPGIMP ? dim : 0;
    /* State-based: two sweeps; yielding: two numbers read and written, and the pair of materials. */
    const double columns = (double)pd->bonds.columns / (double)pd->part.n;
    const double bond = columns * (column_bytes(&pd->bonds) * (j->model >= PD_OSPD && j->kind == BOND_FORCE ? 2 : 1) +
                                   (j->model == PD_BOND_PLASTIC ? 36 * LANES : 0)),
                 apic = j->transfer == TRANSFER_APIC;
    switch (j->kind) {
    case BOND_FORCE:
        return bond + 4 + r * (2 * dim + 1); /* x; f; trigger */
    case BOND_ENERGY:
        return bond + 4 + r * dim;
    case BOND_STRESS:
        return bond + 4 + r * (dim + 1 + symmetric); /* x, volume; stress */
    case PD_MOVE:
        return r * (5 * dim + 1); /* x v f mass; x v */
    case P2G:
        return 4 + r * (3 * dim + 2 + symmetric + stretch + apic * dim * dim) + node * 2 * (1 + 2 * dim);
    case REMAP:
        return 4 + r * (3 * dim + 1 + stretch) + node * 3 * dim;
    case G2P:
    case G2P_YIELDS: /* plastic strain, read and written */
        return (j->kind == G2P_YIELDS ? 2 * r : 0) + 6 +
               r * (2 * dim + 2 + 2 * symmetric + 2 * stretch + apic * (dim + dim * dim)) + node * dim * (apic ? 1 : 2);
    case SPREAD:
        return 4 + r * (dim + 1 + stretch) + node * 2;
    case GRID_CLEAR:
        return node * (1 + 2 * dim);
    case GRID_MOVE:
        return node * (1 + 5 * dim);
    case MESH_CLEAR:
        return mesh_node * dim;
    case MESH_FORCE:
        return mesh_node * 3 * dim; /* u; f read and written */
    case MESH_MOVE:
        return mesh_node * (1 + 5 * dim);
    case CONTACT_SEARCH:
        return contact_bytes(&g->engine[CUT]) + r * 6 * dim; /* positions, cells; reference positions of bonds */
    case CONTACT_FORCE:
        return contact_bytes(&g->engine[CUT]);
    default:
        return node * (1 + 2 * dim);
    }
}

/* Computes the lower limit of the time per particle of each kernel in b->job [s]: its bytes over the memory bandwidth,
 * or for kernels on bonds the time of the arithmetic if that is longer. */
static void find_limits(struct kernel_bench *b)
{
    for (int k = 0; k < b->jobs; k++) {
        struct job *j = &b->job[k];
        struct ground *g = &b->ground[j->dim];
        j->bytes = job_bytes(j, g);
        j->limit = j->bytes / b->limits.triad;
        if (job_visits_bonds(j))
            j->limit = fmax(j->limit, job_bonds_per_particle(j, g) * b->limits.cell_stencil[j->dim]);
    }
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Times all kernels, and the whole runs that have targets, computes lower limits of the times, stores all in *b, and
 * prints and writes the results. quick: few repetitions. Returns FAILED if a run or a file fails. */
static status kernels_run(struct kernel_bench *b, bool quick)
{
    TRY(bench_targets_measure_memory(&b->targets));
    threads_set_count_and_bind_to_cores(1);
    bench_print_machine(1);
    for (int d = 1; d <= DIM_MAX; d++) TRY(ground_make(&b->ground[d], d));
    time_all(b, quick);
    find_limits(b);
    kernels_print(b);
    TRY(bench_targets_measure_speed(&b->targets, quick));
    bench_targets_print(&b->targets);
    return kernels_write(b);
}

status bench_kernels(bool quick)
{
    struct kernel_bench *b = NEW("bench", 1, struct kernel_bench);
    b->jobs = COUNT_OF(all_jobs);
    b->job = NEW("bench.job", b->jobs, struct job);
    memcpy(b->job, all_jobs, sizeof all_jobs);
    for (int k = 0; k < b->jobs; k++) b->job[k].seconds = INFINITY;
    printf("kernels\n");
    status s = kernels_run(b, quick);
    for (int d = 1; d <= DIM_MAX; d++) ground_free(&b->ground[d]);
    bench_table_free(&b->targets.timers);
    memory_free(b->job);
    memory_free(b);
    return s;
}
