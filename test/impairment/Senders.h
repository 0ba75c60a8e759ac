// Senders that are not exact: frames that are spread or interrupted, noise before them, another receiver in mid frame.
#pragma once

#include "Conditions.h"

const std::vector<Condition> &senderLines();
