// What every use of Ipopt sets.
#pragma once

#include <IpIpoptApplication.hpp>

namespace pbd::reference {

/// Silent, without scaling or relaxed bounds of its own, at one tolerance for everything.
Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt_application(double tolerance);

}  // namespace pbd::reference
