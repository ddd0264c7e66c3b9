#pragma once

#include "couplingState.h"
#include "engine/demEngine.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <utility>

namespace clepsydra::tests
{

/// An engine without contacts: particles fall and feel the fluid. Each rank keeps the particles that it was given; none moves
/// to another rank. Steps are explicit: velocity first, then position with the new velocity.
class FakeEngine : public DemEngine
{
public:
    explicit FakeEngine(double timeStep, const Vector3d& gravity = {0, 0, -9.81})
        : timeStep_(timeStep),
          gravity_(gravity)
    {}

    /// On this rank. \param density  [kg/m3]. \pre ids are unique over all ranks. Invalidates views.
    void addParticle(int id, const Vector3d& position, double radius, double density = 2500,
        const Vector3d& velocity = Vector3d::Zero())
    {
        id_.push_back(id);
        position_.push_back(position);
        velocity_.push_back(velocity);
        angularVelocity_.emplace_back(Vector3d::Zero());
        radius_.push_back(radius);
        mass_.push_back(density * sphereVolume(radius));
        state_.emplace_back();
        insertionRamp_.push_back(1);
    }

    /// As addParticle(), and the particle has the state of one that an engine has just made.
    void insertParticle(int id, const Vector3d& position, double radius)
    {
        addParticle(id, position, radius);
        state_.back() = CouplingState::ofNewParticle();
    }

    /// \param torque  of the engine's own, as of a contact, at every step [N m]. \pre this rank has the particle.
    void spinParticle(int id, const Vector3d& angularVelocity, const Vector3d& torque = Vector3d::Zero())
    {
        const auto at = static_cast<std::size_t>(std::find(id_.begin(), id_.end(), id) - id_.begin());
        angularVelocity_[at] = angularVelocity;
        ownTorque_[id] = torque;
    }

    /// From now on no force moves it.
    void holdParticle(int id)
    {
        fixedIds_.insert(id);
    }

    /// What LIGGGHTS does to a particle that leaves its box. \pre this rank has the particle. Invalidates views.
    void removeParticle(int id)
    {
        const auto at = std::find(id_.begin(), id_.end(), id) - id_.begin();
        const auto removeFrom = [at](auto&... lists) { (lists.erase(lists.begin() + at), ...); };
        removeFrom(id_, position_, velocity_, angularVelocity_, radius_, mass_, state_, insertionRamp_);
    }

    void remove(const std::vector<int>& ids) override
    {
        std::for_each(ids.begin(), ids.end(), [this](int id) { removeParticle(id); });
    }

    /// \pre this rank has the particle.
    void moveParticle(int id, const Vector3d& position)
    {
        position_[static_cast<std::size_t>(std::find(id_.begin(), id_.end(), id) - id_.begin())] = position;
    }

    void setContactMaterials(std::vector<ContactMaterial> materials)
    {
        materials_ = std::move(materials);
    }

    /// All pairs of particles of this rank, near or not.
    void requestPairs(double, std::size_t ofState) override
    {
        needsPairs_ = true;
        indexInState_ = ofState;
    }

    /// Not heeded: every particle begins as one that has been in the fluid all along.
    void requestState(const std::vector<double>&) override
    {}

    /// For the particles that there are.
    void requestMemory(int numbers) override
    {
        memory_.setZero(numbers, static_cast<Eigen::Index>(id_.size()));
    }

    void initialise(FluidForces* forces) override
    {
        forces_ = forces;
    }

    void advance(int steps) override
    {
        Eigen::Matrix3Xd force(3, static_cast<Eigen::Index>(id_.size()));
        for (int step = 0; step < steps; ++step)
        {
            evaluateForces(force);
            for (std::size_t particle = 0; particle < id_.size(); ++particle)
            {
                const auto column = static_cast<Eigen::Index>(particle);
                if (!held_[column])
                {
                    velocity_[particle] += timeStep_ * (gravity_ + force.col(column) / mass_[particle]);
                    position_[particle] += timeStep_ * velocity_[particle];
                    angularVelocity_[particle] += timeStep_
                                                  / (0.4 * mass_[particle] * radius_[particle] * radius_[particle])
                                                  * torque_.col(column);
                }
            }
        }
    }

    void prepare() override
    {}

    /// The forces of a step, which is not made.
    void evaluateFluidForces() override
    {
        Eigen::Matrix3Xd force(3, static_cast<Eigen::Index>(id_.size()));
        evaluateForces(force);
    }

    ParticlesView particles() override
    {
        const auto count = static_cast<Eigen::Index>(id_.size());
        const auto vectors = [count](const std::vector<Vector3d>& list) {
            return ConstVectors(list.empty() ? nullptr : list.front().data(), 3, count);
        };
        return {ConstView<int>(id_.data(), count), vectors(position_), vectors(velocity_), vectors(angularVelocity_),
            ConstView<double>(radius_.data(), count), ConstView<double>(mass_.data(), count), state_.data(),
            ConstVectors(weight_.data(), 3, weight_.cols()),
            ParticlePairs{vectors(position_), vectors(velocity_), ConstView<double>(radius_.data(), count),
                ConstView<double>(ofState_.data(), ofState_.size()),
                Eigen::Map<const Eigen::Matrix2Xi>(pairs_.data(), 2, pairs_.cols())},
            memory_.data(), memory_.rows(), true, ConstView<bool>(held_.data(), held_.size()), insertionRamp_.data(),
            Vectors(torque_.data(), 3, torque_.cols())};
    }

    double timeStep() const override
    {
        return timeStep_;
    }

    Vector3d gravity() const override
    {
        return gravity_;
    }

    std::vector<ContactMaterial> contactMaterials() const override
    {
        return materials_;
    }

    /// A line per particle of this rank: id, position, velocity.
    std::vector<std::filesystem::path> writeCheckpoint(const std::filesystem::path& file) override
    {
        std::ofstream out(file);
        out.precision(17);
        for (std::size_t particle = 0; particle < id_.size(); ++particle)
        {
            out << id_[particle] << ' ' << position_[particle].transpose() << ' ' << velocity_[particle].transpose()
                << '\n';
        }
        return {file};
    }

    std::string version() const override
    {
        return "fake engine";
    }

private:
    void evaluateForces(Eigen::Matrix3Xd& force)
    {
        force.setZero();
        weight_.resize(3, force.cols());
        for (Eigen::Index particle = 0; particle < force.cols(); ++particle)
        {
            weight_.col(particle) = mass_[static_cast<std::size_t>(particle)] * gravity_;
        }
        torque_.setZero(3, force.cols());
        for (Eigen::Index particle = 0; particle < force.cols() && !ownTorque_.empty(); ++particle)
        {
            torque_.col(particle) = ownTorque_[id_[static_cast<std::size_t>(particle)]];
        }
        held_.resize(force.cols());
        std::transform(id_.begin(), id_.end(), held_.begin(), [&](int id) { return fixedIds_.count(id) > 0; });
        listPairs();
        if (forces_ != nullptr)
        {
            forces_->evaluate(particles(), timeStep_, Vectors(force.data(), 3, force.cols()));
        }
    }

    void listPairs()
    {
        const int count = needsPairs_ ? static_cast<int>(id_.size()) : 0;
        ofState_.resize(count);
        for (int particle = 0; particle < count; ++particle)
        {
            ofState_[particle] = numbersOf(state_[static_cast<std::size_t>(particle)])[indexInState_];
        }
        pairs_.resize(2, count * (count - 1) / 2);
        Eigen::Index pair = 0;
        for (int first = 0; first < count; ++first)
        {
            for (int second = first + 1; second < count; ++second)
            {
                pairs_.col(pair++) << first, second;
            }
        }
    }

    double timeStep_;
    Vector3d gravity_;
    FluidForces* forces_ = nullptr;
    std::vector<ContactMaterial> materials_;

    std::vector<int> id_;
    // Eigen::Vector3d is three doubles without padding, so a vector of them is a 3 x n matrix.
    std::vector<Vector3d> position_;
    std::vector<Vector3d> velocity_;
    std::vector<Vector3d> angularVelocity_;
    std::vector<double> radius_;
    std::vector<double> mass_;
    std::vector<CouplingState> state_;
    std::vector<double> insertionRamp_;
    /// Of the step that advance() is in.
    Eigen::Matrix3Xd weight_;
    /// Of that step too: the engine's own by id, and with the fluid's.
    std::map<int, Vector3d> ownTorque_;
    Eigen::Matrix3Xd torque_;
    std::set<int> fixedIds_;
    Eigen::Array<bool, Eigen::Dynamic, 1> held_;
    bool needsPairs_ = false;
    std::size_t indexInState_ = 0;
    Eigen::ArrayXd ofState_;
    Eigen::Matrix2Xi pairs_;
    Eigen::MatrixXd memory_;
};

} // namespace clepsydra::tests
