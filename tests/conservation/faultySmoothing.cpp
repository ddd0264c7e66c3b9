// What tests name as `smoothingModel faulty`: see faultyStream().

#include "distribution/smoothingModel.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra::tests
{

namespace
{

class FaultySmoothing final : public SmoothingModel
{
public:
    TypeName("faulty");

    FaultySmoothing(const dictionary& coefficients, const fvMesh&)
        : rowCount_(coefficients.get<label>("rowCount")),
          row_(coefficients.get<label>("row")),
          factor_(coefficients.get<double>("factor")),
          inAllCells_(coefficients.get<word>("cells") == "all")
    {}

    void nearTo(const std::vector<label>&, RankTotals&) override
    {}

    void smooth(Eigen::MatrixXd& densities) const override
    {
        if (densities.rows() != rowCount_)
        {
            return;
        }
        auto row = densities.row(row_);
        if (inAllCells_)
        {
            row *= factor_;
        }
        else
        {
            row[0] *= factor_;
        }
    }

    double bandwidth() const override
    {
        return 0;
    }

    string description() const override
    {
        return "faulty";
    }

private:
    const label rowCount_;
    const label row_;
    const double factor_;
    const bool inAllCells_;
};

defineTypeNameAndDebug(FaultySmoothing, 0);
addToRunTimeSelectionTable(SmoothingModel, FaultySmoothing, dictionary);

} // namespace

} // namespace clepsydra::tests
