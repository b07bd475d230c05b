// Siconos on a body in the plane whose corners or circles meet a floor at y = 0: Moreau and Jean's steps with impact and friction.
//
//     MASS INERTIA GRAVITY_X GRAVITY_Y RESTITUTION FRICTION STEP STEPS  X Y ANGLE VX VY OMEGA  [FOOT_X FOOT_Y RADIUS]...
//
// Prints x y angle vx vy omega after every step, in SI units, and at last the processor time of the steps.

#include <SiconosKernel.hpp>
#include <SolverOptions.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

// Of the method: half the forces at the beginning of a step, half at its end.
const double THETA = 0.5;
// Of the solver of contacts.
const double TOLERANCE = 1e-13;
const unsigned SHARED = 14, EACH = 3;

// The gap under a circle about a point of the body, and how gap and place of touch move with x, y and angle.
class Foot : public LagrangianScleronomousR {
    const double *given;

    double right(double angle) const { return given[0] * std::cos(angle) - given[1] * std::sin(angle); }
    double up(double angle) const { return given[0] * std::sin(angle) + given[1] * std::cos(angle); }

public:
    explicit Foot(const double *from) : given(from) {
        _jachq = std::make_shared<SimpleMatrix>(2, 3);
        _jachq->zero();
        _jachq->setValue(0, 1, 1);
        _jachq->setValue(1, 0, 1);
    }

    void computeh(const BlockVector &q, BlockVector &, SiconosVector &gap) override {
        gap.setValue(0, q.getValue(1) + up(q.getValue(2)) - given[2]);
    }

    void computeJachq(const BlockVector &q, BlockVector &) override {
        _jachq->setValue(0, 2, right(q.getValue(2)));
        _jachq->setValue(1, 2, given[2] - up(q.getValue(2)));
    }
};

static SP::SiconosVector vector_of(double x, double y, double z) {
    auto vector = std::make_shared<SiconosVector>(3);
    const double values[] = {x, y, z};
    for (unsigned index = 0; index < 3; ++index) vector->setValue(index, values[index]);
    return vector;
}

static SP::LagrangianDS body_of(const std::vector<double> &given) {
    auto matrix = std::make_shared<SimpleMatrix>(3, 3);
    matrix->zero();
    for (unsigned index = 0; index < 3; ++index) matrix->setValue(index, index, given[index < 2 ? 0 : 1]);
    auto place = vector_of(given[8], given[9], given[10]), rate = vector_of(given[11], given[12], given[13]);
    auto body = std::make_shared<LagrangianLinearTIDS>(place, rate, matrix);
    body->setFExtPtr(vector_of(given[0] * given[2], given[0] * given[3], 0));
    return body;
}

static SP::TimeStepping simulation_of(const std::vector<double> &given, SP::LagrangianDS body) {
    const double step = given[6], until = (given[7] + 2) * step;
    auto scene = std::make_shared<NonSmoothDynamicalSystem>(0, until);
    scene->insertDynamicalSystem(body);
    auto law = std::make_shared<NewtonImpactFrictionNSL>(given[4], 0, given[5], 2);
    for (unsigned index = SHARED; index < given.size(); index += EACH) {
        scene->link(std::make_shared<Interaction>(law, std::make_shared<Foot>(&given[index])), body);
    }
    auto problem = std::make_shared<FrictionContact>(2);
    problem->numericsSolverOptions()->dparam[SICONOS_DPARAM_TOL] = TOLERANCE;
    auto times = std::make_shared<TimeDiscretisation>(0, step);
    return std::make_shared<TimeStepping>(scene, times, std::make_shared<MoreauJeanOSI>(THETA), problem);
}

int main(int count, char **words) {
    std::vector<double> given;
    for (int index = 1; index < count; ++index) given.push_back(std::atof(words[index]));
    if (given.size() < SHARED + EACH || (given.size() - SHARED) % EACH != 0) {
        std::fprintf(stderr, "the head of the source says what has to be given\n");
        return 2;
    }
    auto body = body_of(given);
    auto simulation = simulation_of(given, body);
    std::clock_t spent = 0;
    for (long number = std::lround(given[7]); number > 0; --number) {
        const std::clock_t begin = std::clock();
        simulation->computeOneStep();
        spent += std::clock() - begin;
        for (unsigned index = 0; index < 3; ++index) std::printf("%.17g ", body->q()->getValue(index));
        for (unsigned index = 0; index < 3; ++index) std::printf("%.17g ", body->velocity()->getValue(index));
        std::printf("\n");
        simulation->nextStep();
    }
    std::printf("%.6f\n", static_cast<double>(spent) / CLOCKS_PER_SEC);
    return 0;
}
