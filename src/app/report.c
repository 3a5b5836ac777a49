/* Implements `cleave report`: reads the arguments of the command. The functions in src/report write the report. */
#include "report/report.h"

#include <string.h>

#include "commands.h"

static const char usage[] = "report " REPORT_WORDS;

status command_report_main(int argc, char **argv)
{
    struct report_request r = {0};
    for (int k = 1; k < argc; k++) {
        if (!strcmp(argv[k], "--overwrite"))
            r.overwrite = true;
        else if (!strcmp(argv[k], "-q"))
            r.quiet = true;
        else if (!strcmp(argv[k], "-o") && k + 1 < argc)
            r.out = argv[++k];
        else if (argv[k][0] == '-')
            return status_set(REFUSED, "report: unknown option %s; usage: cleave %s", printable_name(argv[k]).text,
                              usage);
        else if (r.folder)
            return status_set(REFUSED, "report: %s is a second folder; give only one folder",
                              printable_name(argv[k]).text);
        else
            r.folder = argv[k];
    }
    if (!r.folder) return status_set(REFUSED, "report: no folder is given; usage: cleave %s", usage);
    return report_write_html_page(&r);
}
