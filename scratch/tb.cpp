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
  for(double t:{-2.,0.,2.}){
  std::vector<Eigen::VectorXd> truth(study.conditions.size());
  { Study ws=study; ws.settings.seed=999; Simulator w(ws,rig);
    for(auto c:study.conditionsOf(Role::training)){ Setting st=w.plainSetting(); st.parameters(0)+=t*study.parameters[0].sd; auto sims=w.repeats({c},st,"truth",2000); Eigen::MatrixXd all(2000,study.featureCount()); for(int i=0;i<2000;++i) all.row(i)=sims[i].features.transpose();
      truth[c]=all.colwise().mean(); } }
  int L=8; Eigen::VectorXd tt(1);tt<<t;
  Eigen::MatrixXd b=Eigen::MatrixXd::Zero(6,5),v=b,u=b, slope=b,quad=b;
  for(int l=0;l<L;++l){ study.settings.seed=1000+l; Simulator sim(study,rig); Library lib=makeLibrary(sim);
    Emulator em(study,sim,lib.runs,feats);
    for(int c=0;c<6;++c){ Eigen::VectorXd p=em[c]->mean({})*parameterTermsAt(tt); auto uu=em[c]->uncertainty(tt,{});
     for(int f=0;f<5;++f){ double s=std::sqrt(em[c]->noise(f,f)); double d=(p(f)-truth[c](f))/s; b(c,f)+=d/L; v(c,f)+=d*d/L; u(c,f)+=uu(f,f)/s/s/L; slope(c,f)+=em[c]->mean({})(f,1)/s/L; quad(c,f)+=em[c]->mean({})(f,2)/s/L;}}}
  std::cout<<std::fixed<<std::setprecision(2)<<"t "<<t<<" bias\n"<<b<<"\nrms\n"<<v.cwiseSqrt()<<"\nstated\n"<<u.cwiseSqrt()<<"\nslope\n"<<slope<<"\nquad\n"<<quad<<"\n";
  }
}
