/* A second translation unit with the header: nothing in it may be defined twice. */

#include "chamfer.h"

const char *name_from_the_second_unit(void);

const char *name_from_the_second_unit(void) {
    return chamfer_reason_string(CHAMFER_REASON_NO_ROOM);
}
