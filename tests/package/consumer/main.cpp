// Uses the installed headers and the installed library: builds a deployment and prints its size.
#include <iostream>

#include "model/scenario.hpp"

int main() {
  stormproof::model::Scenario scenario;
  scenario.deployment = stormproof::model::Deployment::homogeneous(2, 1, 2);
  std::cout << scenario.deployment.size() << " participants\n";
}
