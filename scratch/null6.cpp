#include "standIn/standIn.h"
#include "emulator/emulator.h"
#include "emulator/settings.h"
#include "decision/evidence.h"
#include "decision/calibration.h"
#include "decision/replicas.h"
#include "study/readStudy.h"
#include <iostream>
#include <iomanip>
using namespace clepsydra::identification;
using namespace clepsydra::identification::tests;
int main(int argc,char**argv){
  Study study=readStudy(argv[1]); study.settings.budget=100000000;
  const Entries defaults=readEntries(study.rig.caseFolder/study.rig.entriesFile);
  StandInRig rig(defaults);
  std::mt19937_64 rnd(5);
  std::normal_distribution<double> normal;
  std::vector<int> cov(study.effects.size(),0), tot(study.effects.size(),0);
  std::vector<double> z2(study.effects.size(),0);
  Eigen::MatrixXd RES=Eigen::MatrixXd::Zero(6,5); double RF=0,RF2=0,RN=0; double N=0,S=0,M=0,F=0,F2=0,FC=0; Eigen::VectorXd eff=Eigen::VectorXd::Zero(14),eff2=eff; double fa[5]={0},fm[5]={0}; double lev[5]={.01,.05,.1,.25,.5};
  for(int lib=0;lib<8;++lib){
  study.settings.seed=1000+lib;
  Simulator sim(study,rig);
  Library library=makeLibrary(sim);
  Study ws=study; 

    for(int k=0;k<20;++k){
      ws.settings.seed=77777+k+10000*lib;
      Simulator world(ws,rig);
      Setting st=world.plainSetting(); double t=std::atof(argv[2]); st.parameters(0)+=t*study.parameters[0].sd;
      std::vector<MeasuredCondition> data(study.conditions.size());
      for(auto c:study.conditionsOf(Role::training)){
        auto sims=world.repeats({c},st,"measured",3);
        data[c].features.resize(3,study.featureCount());
        for(int i=0;i<3;++i) data[c].features.row(i)=sims[i].features.transpose();
        data[c].declaredError=Eigen::VectorXd::Zero(study.featureCount());
      }
      for(auto c:study.conditionsOf(Role::heldOut)) {data[c].features.resize(0,study.featureCount());data[c].declaredError=Eigen::VectorXd::Zero(study.featureCount());}
      Emulator em(study,sim,library.runs,measuredFeatures(study,data));
      auto [layout,measured]=arrange(study,em,data);
      Evidence ev0(study,em,layout,Eigen::VectorXd::Zero(1));
      Eigen::VectorXd tt(1); tt<<t;
      
      Evidence ev(study,em,layout,ev0.fitNull(measured).parameters);
      ev.refine(measured);
      for(std::size_t b=0;b<layout.blocks.size();++b){const auto&B=layout.blocks[b]; const auto&ce=*em[B.condition]; Eigen::VectorXd p=ce.mean({})*parameterTermsAt(tt); for(int f=0;f<5;++f) RES(b,f)+=(p(f)-measured.mean(B.first+f))/std::sqrt(ce.noise(f,f))/160;}
      Odds odds=oddsOf(study,ev(measured));
      Fit fit=ev.fitNull(measured);
      Replicas reps(em,layout,ev,rnd); std::vector<double> stats, mis;
      for(int i=0;i<120;++i){ Eigen::VectorXd p=fit.parameters; p(0)+=std::sqrt(fit.covariance(0,0))*normal(rnd); if(argc>3) p(0)=t; auto trial=reps.draw({},p,rnd); stats.push_back(oddsOf(study,trial.judge(trial.data)).statistic); Fit ff=trial.judge.fitNull(trial.data); mis.push_back(ff.misfit); RF+=ff.parameters(0)-p(0); RF2+=std::pow(ff.parameters(0)-p(0),2); RN++;}
      int above=0, ab2=0; for(double x:stats) above+=x>=odds.statistic; for(double x:mis) ab2+=x>=fit.misfit;
      double p=above/120.0, p2=ab2/120.0;
      int best; odds.effects.maxCoeff(&best);
      {double m=0; for(double x:stats) m+=x/stats.size(); S+=odds.statistic; M+=m; F+=fit.parameters(0); F2+=std::pow(fit.parameters(0)-t,2); FC+=fit.covariance(0,0); for(int i=0;i<(int)odds.effects.size();++i) {eff(i)+=odds.effects(i)+odds.statistic;} auto tr=reps.draw({},fit.parameters,rnd); Odds o2=oddsOf(study,tr.judge(tr.data)); for(int i=0;i<(int)odds.effects.size();++i) eff2(i)+=o2.effects(i)+o2.statistic; }
      N++; for(int q=0;q<5;++q){ fa[q]+=p<lev[q]; fm[q]+=p2<lev[q]; }
      if(p<.05) std::cout<<"t "<<t<<" fit "<<fit.parameters(0)<<" p "<<p<<" pMisfit "<<p2<<" misfit "<<fit.misfit<<" rows "<<layout.rows<<" spread "<<" best "<<study.effects[best].name<<" "<<std::exp(odds.effects(best))<<" other "<<std::exp(odds.other)<<"\n";
    }
  }
std::cout<<"replica fit error "<<RF/RN<<" rms "<<std::sqrt(RF2/RN)<<"\n"; std::cout<<RES<<"\n"; std::cout<<"statistic "<<S/N<<" of draws "<<M/N<<" fit "<<F/N<<" rms error "<<std::sqrt(F2/N)<<" stated "<<std::sqrt(FC/N)<<"\n"; for(int i=0;i<14;++i) std::cout<<study.effects[i].name<<" "<<eff(i)/N<<" draws "<<eff2(i)/N<<"\n"; for(int q=0;q<5;++q) std::cout<<lev[q]<<": odds "<<fa[q]/N<<" misfit "<<fm[q]/N<<"\n";}
