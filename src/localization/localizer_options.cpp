#include "localization/localizer_options.h"
