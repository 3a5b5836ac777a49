/* Target of fuzz.h: particle lists in CSV. They are refused in one line, or all positions and velocities of an accepted
 * list are finite and its materials have names or numbers in range. */
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "scene/particle_list.h"

void fuzz_list(const uint8_t *bytes, size_t n)
{
    struct particle_list l;
    const int dim = n > 0 ? 1 + bytes[0] % 3 : 1, fd = open("fuzz_list.csv", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (fd < 0 || (n > 1 && write(fd, bytes + 1, n - 1) != (ssize_t)(n - 1)))
        fuzz_fail("cannot write", "fuzz_list.csv");
    close(fd);
    status_set(OK, "%s", "");
    if (particle_list_read(&l, "fuzz_list.csv", NULL, dim) != OK) {
        if (!status_message()[0] || strchr(status_message(), '\n'))
            fuzz_fail("refused without a line", status_message());
        return;
    }
    for (int64_t i = 0; i < l.n; i++)
        for (int d = 0; d < dim; d++)
            if (!isfinite(l.X[d][i]) || (l.v[d] && !isfinite(l.v[d][i]))) fuzz_fail("a place that is no number", "");
    for (int64_t i = 0; i < l.n && l.material; i++)
        if (l.material[i] < -l.names || l.material[i] > UINT8_MAX) fuzz_fail("a material without a name", "");
    particle_list_free(&l);
}
