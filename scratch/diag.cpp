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
  study.settings.seed=1000;
  Simulator sim(study,rig);
  Library lib=makeLibrary(sim);
  std::vector<std::vector<Eigen::Index>> feats(study.conditions.size());
  for(auto c:study.conditionsOf(Role::training)) for(Eigen::Index f=0;f<study.featureCount();++f) feats[c].push_back(f);
  Emulator em(study,sim,lib.runs,feats);
  for(auto&r:em.remarks()) std::cout<<r<<"\n";
  for(double s:em.scales()) std::cout<<s<<" "; std::cout<<" lof "<<em.lackOfFit()<<"\n";
  Study ws=study; ws.settings.seed=77777;
  Simulator world(ws,rig);
  const int N=200;
  for(std::size_t e=0;e<study.effects.size();++e){
    for(double a:{-0.9,0.9}){ if(a<study.effects[e].bounds.lower) continue;
     for(double tt:{-1.5,1.5}){
      std::cout<<std::setw(16)<<study.effects[e].name<<" a "<<a<<" t "<<tt<<": ";
      double b2=0,rr=0,eff=0,chi=0, chiu=0;int n=0;
      Setting st=world.plainSetting(); st.parameters(0)+=tt*study.parameters[0].sd; st.amplitudes(e)=a;
      Eigen::VectorXd t(1);t<<tt;
      for(auto c:study.conditionsOf(Role::training)){
        auto sims=world.repeats({c},st,"truth",N);
        Eigen::VectorXd m=Eigen::VectorXd::Zero(study.featureCount());
        Eigen::MatrixXd all(N,study.featureCount());
        for(int i=0;i<N;++i) all.row(i)=sims[i].features.transpose();
        m=all.colwise().mean();
        Eigen::MatrixXd dev=all.rowwise()-all.colwise().mean();
        Eigen::VectorXd sd=(dev.cwiseAbs2().colwise().sum()/(N-1)).cwiseSqrt();
        const auto& ce=*em[c];
        Eigen::VectorXd p=ce.mean({{e,a}})*parameterTermsAt(t);
        Eigen::MatrixXd u=ce.uncertainty(t,{{e,a}});
        
        for(int f=0;f<(int)p.size();++f){ double fs=std::sqrt(ce.noise(f,f));
          double bb=(p(f)-m(ce.features[f]))/fs, uu=std::sqrt(u(f,f))/fs; bool act=acts(study.effects[e],study.conditions[c]); if(act){chi+=bb*bb/(uu*uu+1.0/N); chiu+=uu*uu; n++; b2+=bb*bb; rr+=std::log(sd(ce.features[f])/fs); double x0=(ce.mean({{e,a}})-ce.mean({})).col(0)(f)/fs; eff+=x0*x0; }}
      }
      std::cout<<std::fixed<<std::setprecision(2)<<"effect "<<std::sqrt(eff/n)<<" bias "<<std::sqrt(b2/n)<<" stated "<<std::sqrt(chiu/n)<<" rms z "<<std::sqrt(chi/n)<<" noise "<<std::exp(rr/n)<<"\n";
     }
    }
  }
}
