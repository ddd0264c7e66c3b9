#include "standIn/standIn.h"
#include "emulator/emulator.h"
#include "emulator/settings.h"
#include "study/readStudy.h"
#include <iostream>
#include <iomanip>
using namespace clepsydra::identification;
using namespace clepsydra::identification::tests;
int main(int argc,char**argv){
  Study study=readStudy(argv[1]); study.settings.budget=100000000;
  const Entries defaults=readEntries(study.rig.caseFolder/study.rig.entriesFile);
  StandInRig rig(defaults);
  std::vector<std::vector<Eigen::Index>> feats(study.conditions.size());
  for(auto c:study.conditionsOf(Role::training)) for(Eigen::Index f=0;f<study.featureCount();++f) feats[c].push_back(f);
  double t=0;
  std::vector<Eigen::VectorXd> truth(6); std::vector<Eigen::MatrixXd> cov(6);
  { Study ws=study; ws.settings.seed=999; Simulator w(ws,rig);
    for(auto c:study.conditionsOf(Role::training)){ auto sims=w.repeats({c},w.plainSetting(),"truth",3000); Eigen::MatrixXd all(3000,study.featureCount()); for(int i=0;i<3000;++i) all.row(i)=sims[i].features.transpose();
      truth[c]=all.colwise().mean(); Eigen::MatrixXd d=all.rowwise()-all.colwise().mean(); cov[c]=d.transpose()*d/2999;} }
  int L=40; Eigen::VectorXd tt(1);tt<<t;
  Eigen::VectorXd e2=Eigen::VectorXd::Zero(6),st=e2,nz=e2,nt=e2; double all2=0,allst=0;
  Eigen::VectorXd mm=Eigen::VectorXd::Zero(6);
  for(int l=0;l<L;++l){ study.settings.seed=1000+l; Simulator sim(study,rig); Library lib=makeLibrary(sim);
    Emulator em(study,sim,lib.runs,feats); double sum=0,sums=0;
    for(int c=0;c<6;++c){ Eigen::VectorXd p=em[c]->mean({})*parameterTermsAt(tt); auto uu=em[c]->uncertainty(tt,{});
      Eigen::VectorXd v(5); v<<1,1,1,-1,0; v/=2; for(int f=0;f<5;++f) v(f)/=std::sqrt(cov[c](f,f));
      double e=v.dot(p-truth[c]), s=v.dot(uu*v); e2(c)+=e*e/L; st(c)+=s/L; mm(c)+=e/L; nz(c)+=v.dot(em[c]->noise*v)/L; nt(c)=v.dot(cov[c]*v); if(c<3){sum+=e; sums+=s;} }
    all2+=sum*sum/L; allst+=sums/L; }
  std::cout<<"error^2 "<<e2.transpose()<<"\nstated  "<<st.transpose()<<"\nmean "<<mm.transpose()<<"\nnoise emulated "<<nz.transpose()<<"\nnoise true "<<nt.transpose()<<"\n dry sum "<<all2<<" stated "<<allst<<"\n";
}
