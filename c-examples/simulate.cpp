/* Runs a model file and prints the range of one of its variables, with a class that owns the simulation. */
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "ancf14.h"

/* A simulation that is freed at the end of its scope, and whose calls throw where they fail. */
class Simulation {
  public:
    explicit Simulation(const std::string &path) {
        char error[4096];
        handle.reset(ancf14_load_file(path.c_str(), nullptr, error, sizeof error));
        if (!handle) {
            throw std::runtime_error(error);
        }
    }
    int find(const std::string &name) {
        int variable = ancf14_find(handle.get(), name.c_str());
        check(variable < 0 ? ANCF14_UNKNOWN_VARIABLE : ANCF14_OK);
        return variable;
    }
    double get(int variable) {
        double value = 0.0;
        check(ancf14_get(handle.get(), variable, &value));
        return value;
    }
    void set(int variable, double value) { check(ancf14_set(handle.get(), variable, value)); }
    void initialize() { check(ancf14_initialize(handle.get())); }
    void advance(double time) { check(ancf14_advance(handle.get(), time)); }
    double stop_time() { return ancf14_stop_time(handle.get()); }
    double output_step() { return ancf14_output_step(handle.get()); }

  private:
    struct Free {
        void operator()(ancf14_simulation *simulation) const { ancf14_free(simulation); }
    };
    std::unique_ptr<ancf14_simulation, Free> handle;

    void check(ancf14_status status) {
        if (status != ANCF14_OK) {
            throw std::runtime_error(ancf14_last_error(handle.get()));
        }
    }
};

int main(int count, char **words) {
    if (count != 3) {
        std::cerr << "usage: simulate_cpp MODEL.toml VARIABLE\n";
        return EXIT_FAILURE;
    }
    try {
        Simulation simulation(words[1]);
        int variable = simulation.find(words[2]);
        simulation.initialize();
        double smallest = simulation.get(variable), largest = smallest;
        long rows = std::lround(simulation.stop_time() / simulation.output_step());
        for (long row = 1; row <= rows; row++) {
            simulation.advance(static_cast<double>(row) * simulation.output_step());
            smallest = std::min(smallest, simulation.get(variable));
            largest = std::max(largest, simulation.get(variable));
        }
        std::cout << words[2] << " is between " << smallest << " and " << largest << "\n";
    } catch (const std::exception &failure) {
        std::cerr << failure.what() << "\n";
        return EXIT_FAILURE;
    }
}
