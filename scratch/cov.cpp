#include "standIn/standIn.h"
#include "emulator/emulator.h"
#include "emulator/settings.h"
#include "decision/evidence.h"
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
  for(int lib=0;lib<4;++lib){
  study.settings.seed=1000+lib;
  Simulator sim(study,rig);
  Library library=makeLibrary(sim);
  Study ws=study; 
  for(std::size_t e=0;e<study.effects.size();++e){
    std::cout<<std::setw(16)<<study.effects[e].name<<": ";
    for(int k=0;k<6;++k){
      ws.settings.seed=77777+k+100*e+10000*lib;
      Simulator world(ws,rig);
      double a=std::uniform_real_distribution<double>(.25,1)(rnd); if(study.effects[e].bounds.lower<0&&rnd()%2) a=-a;
      Setting st=world.plainSetting(); st.parameters(0)+=normal(rnd)*study.parameters[0].sd; st.amplitudes(e)=a;
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
      Evidence ev(study,em,layout,Eigen::VectorXd::Zero(1));
      ev.refine(measured);
      Fit f=ev.fit(e,measured);
      bool c=f.lower<=a&&a<=f.upper; cov[e]+=c; tot[e]++; z2[e]+=std::pow((f.amplitude-a)/f.sd,2);
      std::cout<<std::fixed<<std::setprecision(2)<<a<<">"<<f.amplitude<<"+-"<<f.sd<<(c?" ":"! ");
    }
    std::cout<<"\n";
  }}
  for(std::size_t e=0;e<cov.size();++e) std::cout<<study.effects[e].name<<" "<<cov[e]<<"/"<<tot[e]<<" rms z "<<std::sqrt(z2[e]/tot[e])<<"\n";
}
