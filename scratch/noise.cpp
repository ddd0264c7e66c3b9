#include "standIn/standIn.h"
#include "emulator/emulator.h"
#include "study/readStudy.h"
#include <iostream>
using namespace clepsydra::identification;
using namespace clepsydra::identification::tests;
int main(int argc,char**argv){
  Study study=readStudy(argv[1]); study.settings.budget=100000000;
  const Entries defaults=readEntries(study.rig.caseFolder/study.rig.entriesFile);
  StandInRig rig(defaults);
  std::vector<std::vector<Eigen::Index>> feats(study.conditions.size());
  for(auto c:study.conditionsOf(Role::training)) for(Eigen::Index f=0;f<study.featureCount();++f) feats[c].push_back(f);
  std::vector<Eigen::VectorXd> truth(study.conditions.size());
  { Study ws=study; ws.settings.seed=999; Simulator w(ws,rig);
    for(auto c:study.conditionsOf(Role::training)){ auto sims=w.repeats({c},w.plainSetting(),"truth",1000); Eigen::MatrixXd all(1000,study.featureCount()); for(int i=0;i<1000;++i) all.row(i)=sims[i].features.transpose();
      truth[c]=((all.rowwise()-all.colwise().mean()).cwiseAbs2().colwise().sum()/999).cwiseSqrt(); } }
  double sum=0,sum2=0; int L=20;
  Eigen::MatrixXd bycf=Eigen::MatrixXd::Zero(study.conditions.size(),study.featureCount());
  for(int l=0;l<L;++l){ study.settings.seed=1000+l; Simulator sim(study,rig); Library lib=makeLibrary(sim);
    Emulator em(study,sim,lib.runs,feats); double m=0;int n=0;
    for(auto c:study.conditionsOf(Role::training)) for(int f=0;f<truth[c].size();++f){ double r=std::log(truth[c](f)/std::sqrt(em[c]->noise(f,f))); m+=r;n++; bycf(c,f)+=r/L; }
    m/=n; sum+=m; sum2+=m*m; if(l==0) std::cout<<"nu "<<em.degreesOfFreedom()<<"\n"; }
  std::cout<<"mean log(true/emulated sd) "<<sum/L<<" sd between libraries "<<std::sqrt(sum2/L-sum*sum/L/L)<<"\n"<<bycf<<"\n";
}
